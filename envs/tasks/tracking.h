// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "envs/aircraft/aircraft.h"
#include "envs/tasks/target_limits.h"
#include "envs/tasks/task.h"
#include "envs/tasks/tracking_config.h"

namespace skein {

/// Task columns: the target's position, ft, altitude upwards; then the position at the end of the
/// control step before, where the next one's path begins; the tolerance, ft.
enum TrackingColumn : int {
  kTrackingNorth,
  kTrackingEast,
  kTrackingAltitude,
  kTrackingLastNorth,
  kTrackingLastEast,
  kTrackingLastAltitude,
  kTrackingTolerance,
  kNumTrackingColumns
};

/// Fly to a point (NeuralPlane paper, Tracking). Errors are the target's position relative to the
/// aircraft / units.altitude_error_ft, with its ReferenceUnits (F-16: 1 km), in the axes of
/// `TrackingConfig::error_axes`. Their L2 norm is the distance in all axes. The reward of a step is
/// minus TrackingConfig::distance_weight times it, and `approach_weight` times what it became less
/// by. The target is reached when the straight path of a control step touches the box
/// whose sides lie the episode's tolerance north, east, south, west, above and below of it:
/// `position_tolerance_ft` in evaluations, in training up to `training_tolerance_max` times as
/// much.
std::unique_ptr<Task> MakeTrackingTask(const TrackingConfig& config, const ReferenceUnits& units,
                                       const TargetLimits& limits = {});

}  // namespace skein
