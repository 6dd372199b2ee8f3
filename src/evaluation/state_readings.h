// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "envs/reference/flight_control.h"
#include "envs/reference/plant.h"
#include "envs/state/state.h"

namespace skein {

/// A column of files of flights (docs/reference/file-formats.md), and what stands there.
using Reading = std::pair<const char*, double>;

/// What an aircraft does at one moment.
struct FlightMoment {
  RigidBodyState body;
  Eigen::Vector3d wind_ft_s;  ///< the air's velocity, north, east, down
  AirData air;                ///< of `body` in that wind
  double nz = 0, ny = 0;      ///< load factors, g
  double power = 0;           ///< of the engine, 0..100
  SurfaceAngles surfaces;
};

/// In feet, seconds and degrees, in the order of the columns: from north_ft to
/// leading_edge_flap_deg.
std::vector<Reading> StateReadings(const FlightMoment& moment);

}  // namespace skein
