// SPDX-License-Identifier: Apache-2.0
#include "envs/plant/plant_draw.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "envs/reference/actuator.h"

namespace skein {
namespace {

int DrawWhole(const WholeRange& range, simd::RandomStream* random) {
  const double position = random->Uniform(range.min, range.max + 1);
  return std::min(static_cast<int>(position), range.max);
}

/// Whole control steps, not before the first.
double FreezeStep(const PlantDraw& draw, double dt) {
  if (draw.frozen_sensor < 0) return kNeverFreezes;
  return std::max(1.0, std::round(draw.freeze_s / dt));
}

/// Of the value as float32.
std::uint32_t UpperHalf(double value) {
  const auto number = static_cast<float>(value);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &number, sizeof bits);
  return bits >> 16;
}

}  // namespace

PlantDraw DrawPlant(const PlantConfig& config, simd::RandomStream* random) {
  const auto draw = [random](const Range& range) { return random->Uniform(range.min, range.max); };
  PlantDraw plant;
  plant.mass = draw(config.mass);
  plant.inertia = draw(config.inertia);
  plant.cg_shift = draw(config.cg_shift);
  plant.axial_force = draw(config.axial_force);
  plant.normal_force = draw(config.normal_force);
  plant.pitching_moment = draw(config.pitching_moment);
  plant.lateral = draw(config.lateral);
  plant.damping = draw(config.damping);
  plant.elevator = plant.aileron = plant.rudder = draw(config.control);
  double* const surfaces[] = {&plant.elevator, &plant.aileron, &plant.rudder};
  const int weak = DrawWhole({0, 2}, random);
  *surfaces[weak] *= draw(config.weak_surface);
  plant.thrust = draw(config.thrust);
  plant.thrust_lag = draw(config.thrust_lag);
  plant.engine_momentum = draw(config.engine_momentum);
  plant.density = draw(config.density);
  plant.pitch_stick = draw(config.pitch_stick);
  plant.roll_stick = draw(config.roll_stick);
  plant.yaw_stick = draw(config.yaw_stick);
  plant.actuator_rate = draw(config.actuator_rate);
  plant.actuator_bandwidth = draw(config.actuator_bandwidth);
  plant.action_delay_steps = DrawWhole(config.action_delay_steps, random);
  plant.observation_delay_steps = DrawWhole(config.observation_delay_steps, random);
  const bool freezes = random->Uniform() < config.sensor_freeze_chance;
  const int sensor = DrawWhole({0, kNumFreezingSensors - 1}, random);
  plant.frozen_sensor = freezes ? sensor : -1;
  plant.freeze_s = draw(config.sensor_freeze_s);
  for (double& scale : plant.sensor_scale) {
    scale = random->Uniform(-config.sensor_scale, config.sensor_scale);
  }
  for (double& bias : plant.sensor_bias) {
    bias = random->Uniform(-config.sensor_bias, config.sensor_bias);
  }
  return plant;
}

float PackSensorError(double scale, double bias) {
  const std::uint32_t bits = UpperHalf(scale) << 16 | UpperHalf(bias);
  float packed = 0;
  std::memcpy(&packed, &bits, sizeof packed);
  return packed;
}

void SetPlant(const PlantDraw& draw, const Aircraft& aircraft, double dt, const PlantTile& plant,
              int index) {
  const auto set = [&](int column, double value) {
    plant[column][index] = static_cast<float>(value);
  };
  set(kPlantInverseMass, 1 / draw.mass);
  set(kPlantInverseInertia, 1 / draw.inertia);
  set(kPlantCgShift, draw.cg_shift);
  set(kPlantAxialForce, draw.axial_force);
  set(kPlantNormalForce, draw.normal_force);
  set(kPlantPitchingMoment, draw.pitching_moment);
  set(kPlantLateral, draw.lateral);
  set(kPlantElevator, draw.elevator);
  set(kPlantAileron, draw.aileron / draw.lateral);
  set(kPlantRudder, draw.rudder / draw.lateral);
  set(kPlantDamping, draw.damping);
  set(kPlantThrust, draw.thrust);
  set(kPlantPowerRate, 1 / draw.thrust_lag);
  set(kPlantEngineMomentum,
      (aircraft.airframe.engine_angular_momentum + draw.engine_momentum) / draw.inertia);
  set(kPlantDensity, draw.density);
  set(kPlantPitchStick, draw.pitch_stick);
  set(kPlantRollStick, draw.roll_stick);
  set(kPlantYawStick, draw.yaw_stick);
  set(kPlantActuatorRate, draw.actuator_rate);
  const Actuators& actuators = aircraft.actuators;
  const auto reached = [&](const Actuator& actuator) {
    return ReachedShare(draw.actuator_bandwidth * actuator.bandwidth_per_s, dt);
  };
  set(kPlantElevatorReached, reached(actuators.elevator));
  set(kPlantAileronReached, reached(actuators.aileron));
  set(kPlantRudderReached, reached(actuators.rudder));
  set(kPlantFlapReached, reached(actuators.leading_edge_flap));
  set(kPlantActionDelay, draw.action_delay_steps);
  set(kPlantObservationDelay, draw.observation_delay_steps);
  set(kPlantFrozenSensor, draw.frozen_sensor);
  set(kPlantFreezeStep, FreezeStep(draw, dt));
  set(kPlantIsFrozen, 0);
  set(kPlantHeld, 0);
  set(kPlantHeldSecond, 0);
  if (!plant.has_sensor_errors) return;
  for (int k = 0; k < kNumSensedNumbers; ++k) {
    const auto sensor = static_cast<std::size_t>(k);
    plant[kPlantSensorErrors + k][index] =
        PackSensorError(draw.sensor_scale[sensor], draw.sensor_bias[sensor]);
  }
}

}  // namespace skein
