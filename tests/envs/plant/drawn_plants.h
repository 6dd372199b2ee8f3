// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/plant/plant_config.h"

namespace skein {

/// Plants of which every part is drawn: body, surfaces, engine, air, sticks, sensors and delays.
inline PlantConfig DrawnPlants() {
  PlantConfig plant;
  plant.mass = plant.inertia = {0.9, 1.1};
  plant.cg_shift = {-0.02, 0.02};
  plant.axial_force = plant.normal_force = plant.pitching_moment = plant.lateral = {0.9, 1.1};
  plant.control = plant.damping = plant.thrust = plant.thrust_lag = {0.9, 1.1};
  plant.weak_surface = {0.7, 1};
  plant.engine_momentum = {0, 160};
  plant.density = {0.95, 1.05};
  plant.pitch_stick = plant.roll_stick = plant.yaw_stick = {0.9, 1.1};
  plant.actuator_rate = plant.actuator_bandwidth = {0.8, 1};
  plant.action_delay_steps = plant.observation_delay_steps = {0, 3};
  plant.sensor_bias = plant.sensor_scale = 0.01;
  plant.sensor_freeze_chance = 0.5;
  plant.sensor_freeze_s = {0.1, 1};
  return plant;
}

}  // namespace skein
