// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "envs/tasks/task_errors.h"
#include "train/measures/flight_measures.h"

namespace skein {

/// An aircraft that holds its target, at the end of one control step.
struct HeldState {
  bool is_within = false;                      ///< within the target's tolerances
  std::array<float, kNumTaskErrors> errors{};  ///< as the task normalises them
  double p_rad_s = 0, q_rad_s = 0, r_rad_s = 0;
  double load_factor = 0;  ///< g
  double sideslip_rad = 0;
  double roll_rad = 0;  ///< in [-pi, pi]
};

/// Adds up the states of a hold. The formulas are in docs/reference/metrics.md.
class HoldSums {
 public:
  void Add(const HeldState& state);
  /// The next state does not follow the latest one: what the roll angle does between them is not
  /// counted.
  void Break() { follows_ = false; }

  /// `asked_s` is how long the target was to be held: what of it was not flown was not within. Pass
  /// 0 for as long as it was.
  HoldMetrics Report(double control_interval_s, double asked_s) const;

 private:
  int count_ = 0, within_ = 0;
  std::array<double, kNumTaskErrors> error_squares_{};
  double p_squares_ = 0, q_squares_ = 0, r_squares_ = 0, sideslip_squares_ = 0;
  double load_factor_mean_ = 0, load_factor_squares_ = 0;  // of deviations from the mean
  double abs_bank_ = 0;
  bool follows_ = false;
  double last_roll_rad_ = 0, rolled_rad_ = 0;
  int roll_changes_ = 0;
};

}  // namespace skein
