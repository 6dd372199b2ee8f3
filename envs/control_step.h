// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "envs/state/state.h"
#include "envs/tasks/episode_progress.h"
#include "envs/tasks/task_errors.h"

namespace skein {

/// What one control step did to consecutive aircraft of a tile.
struct ControlStep {
  int first_aircraft = 0;         ///< index in the environment
  Tile state;                     ///< at its end; `state.count` aircraft
  const float* action = nullptr;  ///< row-major [count][kActionSize], held during it, not clipped
  const float* reward = nullptr;  ///< of the step, terminal reward included; 0 after the end
  const std::int32_t* termination = nullptr;  ///< Termination; kNone while flying
  /// The task's normalised errors, without noise: kNumTaskErrors columns `error_stride` apart.
  const float* errors = nullptr;
  std::size_t error_stride = 0;
  EpisodeProgress progress;  ///< after it; null columns where none is kept
  Tile task;                 ///< the task's columns, targets first, of the step
  /// Pitch, rad, yaw, rad, and true airspeed, ft/s, that a high-level policy asks of the low-level
  /// one; null without a hierarchy.
  Tile command;
};

/// Is shown the control steps of policy steps as they are flown: those of an aircraft in their
/// order.
class ControlStepObserver {
 public:
  virtual ~ControlStepObserver() = default;
  /// Of some aircraft of one tile; tiles may be stepped from different threads.
  virtual void See(const ControlStep& step) = 0;
};

}  // namespace skein
