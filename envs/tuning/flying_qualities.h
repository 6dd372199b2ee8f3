// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "envs/reference/plant.h"
#include "envs/reference/trim.h"
#include "envs/tuning/equivalent_system.h"
#include "envs/tuning/level_limits.h"
#include "envs/tuning/linear_modes.h"
#include "envs/tuning/loop_margins.h"

namespace skein {

/// The response to a step of a stick from trim, in the float64 closed loop: what it adds to the
/// flight with hands off.
struct StepResponse {
  double size = 0;     ///< of the step, share of the full stick
  double reached = 0;  ///< at the end, g or deg/s
  /// From a tenth to nine tenths of that, and beyond it, as a share of it; neither is a number if
  /// what is reached is 0 or not finite.
  double rise_s = 0, overshoot = 0;
};

/// Of what a step of `size` adds, one value or more at every kTrialInterval
/// (envs/tuning/trial_flight.h) after it.
StepResponse MeasureStep(const std::vector<double>& added, double size);

/// A requirement of MIL-F-8785C and how it is met.
struct Requirement {
  const char* paragraph = nullptr;
  std::string what;
  const char* unit = nullptr;
  double value = 0;
  int level = 0;       ///< 1 to 3; 4: not even that
  std::string limits;  ///< of levels 1, 2 and 3
  /// The value is of an equivalent system whose mismatch is beyond kMostMismatch.
  bool is_doubtful = false;
};

/// What MIL-F-8785C asks of the airspeed in a longitudinal motion of these modes: 3.2.1.1 of an
/// aperiodic one that is slow or grows, 3.2.1.2 of a slow oscillatory one, the phugoid. Of several
/// the least stable counts; of none there is no requirement.
std::vector<Requirement> AssessAirspeed(const std::vector<LinearMode>& modes,
                                        const LevelLimits& limits);

/// How a break of a loop stands.
struct LoopAt {
  LoopBreak where;
  LoopMargins margins;
};

/// How an aircraft with flight control flies about a trim.
struct FlyingQualities {
  /// Of the modes of the closed loop that grow faster than pilots bear the one that grows fastest.
  /// With it there are no loops and no equivalent systems: their figures are no numbers, and what
  /// is asked of them is beyond level 3. What grows slowly is judged by its own requirements.
  std::optional<LinearMode> unstable_mode;
  EquivalentShortPeriod short_period;
  EquivalentRoll roll;
  LinearMode dutch_roll;            ///< the oscillatory mode of sideslip and yaw
  double load_factor_by_alpha = 0;  ///< of the airframe at constant speed, g/rad
  StepResponse pitch_step, roll_step;
  /// From full roll stick to a change of bank (LevelLimits::bank_deg); infinity: not within 8 s.
  double bank_deg = 0, bank_s = 0;
  std::vector<LoopAt> loops;
  std::vector<Requirement> requirements;
};

/// At 50 control steps a second, against `limits`. The trim is one in still air, with level wings.
FlyingQualities AssessFlyingQualities(const Plant& plant, const TrimPoint& trim,
                                      const LevelLimits& limits);

}  // namespace skein
