// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/kernels/flight_control_constants.h"
#include "envs/kernels/plant_kernel.h"

namespace skein {

/// Throttle and stick commands of a tile: throttle in [0, 1]; pitch (+ nose up), roll (+ right wing
/// down), yaw (+ nose right) in [-1, 1].
/// Each `count` long, padded as Tile says.
struct PilotColumns {
  const float* throttle = nullptr;
  const float* pitch = nullptr;
  const float* roll = nullptr;
  const float* yaw = nullptr;
};

/// One control step before the integration: reads the sensors from the tile's columns, runs the
/// flight control laws, moves the actuators (exact first-order response, rate and position limits)
/// and sets kPowerCommand. NaN in an aircraft stays there and reaches its surfaces. Stick commands
/// times the gains of `plants`, if those are drawn, are limited to [-1, 1].
void ControlTile(const KernelAircraft& aircraft, const FlightControlConstants& constants, Tile tile,
                 const PilotColumns& pilot, const PlantTile& plants = {});

/// The same, with the constants made for this one call; `dt` in seconds.
void ControlTile(const KernelAircraft& aircraft, Tile tile, const PilotColumns& pilot,
                 FlightControlMode mode, float dt);

}  // namespace skein
