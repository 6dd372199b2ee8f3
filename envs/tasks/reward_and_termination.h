// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "envs/state/state.h"
#include "envs/tasks/task.h"
#include "envs/tasks/termination.h"
#include "envs/tasks/termination_config.h"

namespace skein {

struct KernelAircraft;  // envs/kernels/kernel_aircraft.h

/// The book-keeping of a tile's episodes, one element per aircraft, padded as Tile says.
struct EpisodeColumns {
  std::int32_t* step = nullptr;         ///< control steps flown in this episode
  std::int32_t* termination = nullptr;  ///< Termination; kNone while flying
  float* policy_step_reward = nullptr;  ///< sum over the control steps of this policy step
  float* episode_return = nullptr;
};

/// What ends an episode, and its rewards, as the kernel takes them: made once per configuration.
struct TerminationLimits {
  TerminationLimits(const TerminationConfig& config, const EpisodeSettings& episode);

  /// An angle's range, which spans at most 180 degrees, by the directions of its ends.
  struct AngleRange {
    float sin_min = 0, cos_min = 1, sin_max = 0, cos_max = 1;
  };
  AngleRange alpha, beta;
  float min_mach_squared, max_mach_squared;
  float min_altitude_ft, max_load_factor;
  float failure_reward, success_reward, time_limit_reward;
  float reward_scale;
  std::int32_t time_limit_steps;
};

/// Ends episodes after a control step: counts the step, finds the first Termination (in order of
/// precedence) that holds, and adds the task's reward and the terminal reward. An aircraft whose
/// episode has ended is left alone. A state or reward that is not finite is non_finite, and its
/// step reward counts as zero. At the time limit there is no terminal reward if it truncates.
void ComputeRewardAndTermination(const KernelAircraft& aircraft, const TerminationLimits& limits,
                                 Tile tile, const StepResult& step_result,
                                 const EpisodeColumns& episodes);

}  // namespace skein
