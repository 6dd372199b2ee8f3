// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "envs/actions.h"
#include "envs/tasks/task_errors.h"

namespace skein {

/// The measure of what says nothing: NaN.
inline constexpr float kNoMeasure = std::numeric_limits<float>::quiet_NaN();

/// How smoothly a command was flown. NaN where the series is too short to say.
struct CommandSmoothness {
  float variation_per_s = kNoMeasure;    ///< sum of |changes|, 1/s
  float reversals_per_s = kNoMeasure;    ///< turns back by more than kReversalDeadBand, 1/s
  float power_above_split = kNoMeasure;  ///< share of the power; 0 for a command that never changes
  float saturated = kNoMeasure;          ///< share of the control steps at a stop, -1 or 1
};

/// How a target was held. NaN of what no state says.
struct HoldMetrics {
  float within = kNoMeasure;  ///< share of the time asked for, within tolerances
  /// Root mean squares of the errors as the task normalises them, the body rates (deg/s), and the
  /// sideslip (deg).
  std::array<float, kNumTaskErrors> rms_errors{kNoMeasure, kNoMeasure, kNoMeasure};
  float rms_p = kNoMeasure, rms_q = kNoMeasure, rms_r = kNoMeasure;
  float rms_sideslip = kNoMeasure;
  float load_factor_deviation = kNoMeasure;  ///< standard deviation, g
  float mean_abs_bank = kNoMeasure;          ///< deg
  float net_rolls_per_min = kNoMeasure;      ///< whole turns about the roll axis that do not cancel
};

/// Of throttle, pitch, roll and yaw.
using ActionSmoothness = std::array<CommandSmoothness, kActionSize>;

/// What the control steps of one flight say beside its metrics (envs/flight_metrics.h). Of a flight
/// that ended as non_finite only the counts.
struct FlightMeasures {
  ActionSmoothness actions;       ///< stick actions of the whole flight
  ActionSmoothness hold_actions;  ///< and after the target was reached; NaN without a hold
  /// Over the time after the target was reached; in missions over the time within tolerances, and
  /// `within` is its share of the flight.
  HoldMetrics hold;
  std::int32_t reached_step = 0;  ///< control step at which the target counted as reached; 0: never
  std::int32_t targets_reached = 0, targets_missed = 0;  ///< of a mission
};

}  // namespace skein
