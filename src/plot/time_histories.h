// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "src/plot/picture.h"
#include "src/plot/recordings.h"

namespace skein {

struct HistoryOptions {
  std::vector<std::string> columns;  ///< from top to bottom; empty: targets, then actions
  double width = 518;                ///< of the picture, points
  std::string title;
};

/// Episodes side by side, and below each other what was flown and asked for over time. Throws
/// ChoiceError on columns that are not there and on more episodes than the width has room for.
Picture TimeHistories(const Recordings& recordings, const HistoryOptions& options);

/// How many episodes fit side by side.
int MostHistories(double width);

}  // namespace skein
