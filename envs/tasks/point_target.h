// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "base/range.h"
#include "envs/tasks/target_limits.h"
#include "envs/tasks/task.h"
#include "simd/random.h"

namespace skein {

/// Where a point is drawn from, relative to a flight's start.
struct PointDraw {
  Range distance_ft;
  double azimuth_deg = 0, elevation_deg = 0;  ///< to either side of the nose: U(-x, x)
};

/// A point's north, east and altitude, ft. Takes three numbers of the stream.
std::array<double, 3> DrawPoint(const PointDraw& draw, const FlightStart& start,
                                const TargetLimits& limits, simd::RandomStream* random);

}  // namespace skein
