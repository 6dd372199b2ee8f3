// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "envs/control_step.h"

namespace skein {

/// What one policy step did to each aircraft of a tile. Arrays of `tile_count(tile)`, owned by the
/// caller.
struct StepOutput {
  float* reward = nullptr;  ///< sum over the held control steps, terminal reward included
  /// Termination; kNone while flying. An episode that ended by truncation has kTimeLimit.
  std::uint8_t* termination = nullptr;
  /// Undiscounted return of the episode that ended (else unchanged).
  float* episode_return = nullptr;
  /// Clock of the episode that ended, control steps (else unchanged).
  std::int32_t* episode_steps = nullptr;
  /// Row-major [count][observation_size]; rows of episodes that ended by truncation get their last
  /// observation. May be null if none does (EnvConfig::episode), or nobody asks for it.
  float* final_observation = nullptr;
  ControlStepObserver* observer = nullptr;  ///< is shown every control step; may be null
  /// Row-major [count][kNumFlightMetrics] (envs/flight_metrics.h); rows of episodes that ended get
  /// how they were flown (else unchanged), NaN unless this was asked for in all of their steps. May
  /// be null, and costs nothing then.
  float* flight_metrics = nullptr;
  /// Row-major [count][privileged_size]: beside final_observation what VecEnv::ObservePrivileged
  /// would have written. May be null.
  float* final_privileged = nullptr;
  /// final_observation, which must not be null then, and final_privileged get the rows of every
  /// episode that ended, whatever ended it.
  bool observes_every_end = false;
  /// What the clock of the episode that ended stood at when it began: 0 but in first ones with
  /// EnvConfig::stagger_clocks (else unchanged). May be null.
  std::int32_t* first_clock = nullptr;
};

}  // namespace skein
