#pragma once

#include <cstdint>

#include "envs/dynamics/plant_kernel.h"
#include "envs/env_config.h"
#include "envs/tasks/task.h"
#include "envs/termination.h"

namespace skein {

/// The book-keeping of a tile's episodes, one element per aircraft, padded as Tile says.
struct EpisodeColumns {
  std::int32_t* step = nullptr;         ///< control steps flown in this episode
  std::int32_t* termination = nullptr;  ///< Termination; kNone while flying
  float* decision_reward = nullptr;     ///< sum over the control steps of this decision
  float* episode_return = nullptr;
};

/// Ends episodes after a control step: counts the step, finds the first Termination (in order of
/// precedence) that holds, and adds the task's reward and the terminal reward. An aircraft whose
/// episode has ended is left alone. A state or reward that is not finite is NonFinite, and its step
/// reward counts as zero. At the time limit there is no terminal reward if it truncates.
void JudgeTile(const KernelAircraft& aircraft, const EnvConfig& config, Tile tile,
               const TaskVerdict& verdict, const EpisodeColumns& episodes);

}  // namespace skein
