// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "src/plot/picture.h"
#include "src/plot/seed_curves.h"

namespace skein {

struct CurveOptions {
  std::vector<std::string> columns = {"evaluation_success_rate"};  ///< of metrics.csv, row by row
  /// By task: the success rate of an autopilot (0..1) and what it is called.
  std::map<std::string, std::pair<std::string, double>> autopilots;
  std::string machine;  ///< on which the runs took their times
  double width = 518;   ///< of the picture, points
  std::string title;
};

/// A panel for every task (from left to right) and column (from top to bottom). Throws Error if a
/// column has no values in a run.
Picture TrainingCurves(const std::vector<CurveSetting>& settings, const CurveOptions& options);

}  // namespace skein
