// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "envs/aircraft/aircraft.h"
#include "envs/plant/plant_columns.h"
#include "envs/plant/plant_config.h"
#include "simd/random.h"

namespace skein {

/// The plant of one episode. The members are what PlantConfig's ranges are of; the defaults are the
/// nominal plant.
struct PlantDraw {
  double mass = 1, inertia = 1, cg_shift = 0;
  double axial_force = 1, normal_force = 1, pitching_moment = 1, lateral = 1, damping = 1;
  double elevator = 1, aileron = 1, rudder = 1;  ///< of their effects, a weak one's included
  double thrust = 1, thrust_lag = 1, engine_momentum = 0, density = 1;
  double pitch_stick = 1, roll_stick = 1, yaw_stick = 1;
  double actuator_rate = 1, actuator_bandwidth = 1;
  int action_delay_steps = 0, observation_delay_steps = 0;
  int frozen_sensor = -1;  ///< index in kFreezingSensors
  double freeze_s = 0;
  std::array<double, kNumSensedNumbers> sensor_scale{}, sensor_bias{};  ///< scale: beyond 1
};

/// The same numbers are drawn whatever the ranges: what one quantity is does not depend on others'.
PlantDraw DrawPlant(const PlantConfig& config, simd::RandomStream* random);

/// A sensor's scale error, beyond 1, and its bias in one column entry, so that observations read
/// half as much: the upper halves of both as float32, which rounds what was drawn towards zero by
/// less than a part in 128.
float PackSensorError(double scale, double bias);

/// Puts an aircraft's drawn plant into column entries `index`. `dt` is the control interval, s.
void SetPlant(const PlantDraw& draw, const Aircraft& aircraft, double dt, const PlantTile& plant,
              int index);

}  // namespace skein
