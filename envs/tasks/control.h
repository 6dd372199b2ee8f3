// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "envs/aircraft/aircraft.h"
#include "envs/tasks/control_config.h"
#include "envs/tasks/target_limits.h"
#include "envs/tasks/task.h"

namespace skein {

/// Task columns: the targets, pitch rad in [-pi/2, pi/2], yaw rad in [-pi, pi] and true airspeed
/// ft/s; then the quaternion of the target attitude, whose roll is 0; then what the episode's
/// tolerances are as a share of the configured ones.
enum ControlColumn : int {
  kControlPitch,
  kControlYaw,
  kControlSpeed,
  kControlQ0,
  kControlQx,
  kControlQy,
  kControlQz,
  kControlTolerance,
  kNumControlColumns
};

/// Bring the nose to a given pitch and yaw at a given true airspeed (NeuralPlane paper, Control).
/// Errors are target minus actual: pitch rad, yaw rad in [-pi, pi], speed / units.speed_ft_s, with
/// the aircraft's ReferenceUnits (F-16: 340 m/s). The reward of a step is minus
/// `angle_error_weight` times an angle in rad, from 0 to pi, minus `speed_error_weight` times the
/// absolute speed error in the same unit. The angle is that between the nose and where it should
/// point, or (`reward_includes_roll`) of the one rotation that takes the attitude to the target's.
/// The target is reached by pitch, yaw and speed alone: at any roll.
std::unique_ptr<Task> MakeControlTask(const ControlConfig& config, const ReferenceUnits& units,
                                      const TargetLimits& limits = {});

}  // namespace skein
