// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/point_target.h"

#include <algorithm>
#include <cmath>

#include "envs/aircraft/aircraft.h"

namespace skein {

std::array<double, 3> DrawPoint(const PointDraw& draw, const FlightStart& start,
                                const TargetLimits& limits, simd::RandomStream* random) {
  const auto around = [random](double centre_rad, double change_deg) {
    const double change_rad = change_deg / kDegPerRad;
    return centre_rad + random->Uniform(-change_rad, change_rad);
  };
  const double distance = random->Uniform(draw.distance_ft.min, draw.distance_ft.max);
  const double azimuth = around(start.yaw_rad, draw.azimuth_deg);
  const double elevation = around(start.pitch_rad, draw.elevation_deg);
  return {start.north_ft + distance * std::cos(elevation) * std::cos(azimuth),
          start.east_ft + distance * std::cos(elevation) * std::sin(azimuth),
          std::max(limits.Altitude(start.altitude_ft + distance * std::sin(elevation)),
                   start.lowest_altitude_ft)};
}

}  // namespace skein
