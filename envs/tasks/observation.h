// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "envs/plant/plant_columns.h"
#include "envs/state/state.h"
#include "envs/tasks/observation_layout.h"

namespace skein {

struct KernelAircraft;  // envs/kernels/kernel_aircraft.h

/// An aircraft's observation, float32, in the ReferenceUnits of its type:
///   0-2   the task's errors (Task::Errors)
///   3     altitude / units.altitude_ft (F-16: 5 km)
///   4, 5  sin, cos of roll        6, 7   sin, cos of pitch
///   8     equivalent airspeed / units.speed_ft_s (F-16: 340 m/s)
///   9, 10 sin, cos of alpha       11, 12 sin, cos of beta
///   13-15 p, q, r, rad/s
///   16    engine power / 100
///   17-20 elevator, aileron, rudder, leading-edge flap over their upper limits
///   21    true airspeed / equivalent airspeed
inline constexpr int kObservationSize = kStandardObservation.size();

/// Gaussian noise on every element, drawn from the streams (seed, aircraft, episode, step).
struct ObservationNoise {
  double standard_deviation = 0;  ///< 0 draws none
  std::uint64_t seed = 0;
  std::uint32_t first_aircraft = 0;  ///< global index of the tile's first aircraft
  const std::int32_t* episode = nullptr;
  const std::int32_t* step = nullptr;
  /// If larger, every aircraft's episode has its own standard deviation, at u^power, u uniform in
  /// [0, 1), of the way between the two.
  double max_standard_deviation = 0;
  int power = 1;
};

/// What of a row does not come from the flight.
struct ObservedTask {
  const float* numbers = nullptr;  ///< those that lead it: layout.lead columns `stride` apart
  std::size_t stride = 0;
  ObservationLayout layout = kStandardObservation;
  Tile last_action = {};  ///< layout.actions columns
};

/// Writes observations row-major, [tile.count][task.layout.size()]. Of drawn `plants` it reads the
/// air's density and the sensors' errors, which come before the noise, and shows what frozen
/// sensors hold.
void ObserveTile(const KernelAircraft& aircraft, Tile tile, const ObservedTask& task,
                 const ObservationNoise& noise, float* observation, const PlantTile& plants = {});

}  // namespace skein
