// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "envs/aircraft/aircraft.h"
#include "envs/tasks/heading_config.h"
#include "envs/tasks/target_limits.h"
#include "envs/tasks/task.h"

namespace skein {

/// Task columns: altitude ft, yaw rad in [-pi, pi], true airspeed ft/s; the episode's tolerances as
/// a share of the configured ones.
enum HeadingColumn : int {
  kTargetAltitude,
  kTargetYaw,
  kTargetSpeed,
  kTargetTolerance,
  kNumHeadingColumns
};

/// Turn to a given heading, altitude and true airspeed (NeuralPlane paper, Heading). Errors are
/// target minus actual: altitude / units.altitude_error_ft, yaw rad in [-pi, pi], speed /
/// units.speed_ft_s, with the aircraft's ReferenceUnits (F-16: 1 km, 340 m/s). The reward of a step
/// is minus HeadingConfig::error_norm_weight times their L2 norm, and minus speed_error_weight
/// times the speed's, altitude_error_weight times the altitude's and yaw_error_weight times the
/// yaw's. Reached within the tolerances, in training within the episode's share of them, at or
/// after `HeadingConfig::earliest_success_step`.
std::unique_ptr<Task> MakeHeadingTask(const HeadingConfig& config, const ReferenceUnits& units,
                                      const TargetLimits& limits = {});

}  // namespace skein
