// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "src/run/progress.h"

namespace skein {

/// What a terminal can show.
struct TerminalStyle {
  std::size_t width = 80;  ///< columns that a line may fill
  bool colour = false;     ///< by escape sequences, which take no column
  bool unicode = false;    ///< blocks of eighths; else ASCII
};

/// A training at a glance, for a terminal: lines that fit the width; of what does not, the last is
/// left out first.
std::vector<std::string> LiveView(const Progress& progress, const TerminalStyle& style);

/// Shares, 0 to 1, in `columns` characters or fewer: means over equal parts of them. A space where
/// all are NaN.
std::string Sparkline(const std::vector<double>& shares, std::size_t columns, bool unicode);

}  // namespace skein
