// SPDX-License-Identifier: Apache-2.0
#include "envs/privileged_observation.h"

#include <algorithm>

#include "envs/state/state.h"

namespace skein {
namespace {

constexpr float kPerWindFps = 1.0f / 100;

/// A column of the drawn plant, as (value - nominal) / unit.
struct PlantNumber {
  PlantColumn column;
  const char* name;
  float nominal, unit;
};

// Nominal and unit of what an actuator reaches are about the F-16's.
constexpr PlantNumber kPlantNumbers[] = {
    {kPlantInverseMass, "plant_inverse_mass", 1, 0.2f},
    {kPlantInverseInertia, "plant_inverse_inertia", 1, 0.2f},
    {kPlantCgShift, "plant_cg_shift", 0, 0.05f},
    {kPlantAxialForce, "plant_axial_force", 1, 0.2f},
    {kPlantNormalForce, "plant_normal_force", 1, 0.2f},
    {kPlantPitchingMoment, "plant_pitching_moment", 1, 0.2f},
    {kPlantLateral, "plant_lateral", 1, 0.2f},
    {kPlantElevator, "plant_elevator", 1, 0.3f},
    {kPlantAileron, "plant_aileron", 1, 0.3f},
    {kPlantRudder, "plant_rudder", 1, 0.3f},
    {kPlantDamping, "plant_damping", 1, 0.2f},
    {kPlantThrust, "plant_thrust", 1, 0.2f},
    {kPlantPowerRate, "plant_power_rate", 1, 0.3f},
    {kPlantEngineMomentum, "plant_engine_momentum", 0, 160},
    {kPlantDensity, "plant_density", 1, 0.1f},
    {kPlantPitchStick, "plant_pitch_stick", 1, 0.3f},
    {kPlantRollStick, "plant_roll_stick", 1, 0.3f},
    {kPlantYawStick, "plant_yaw_stick", 1, 0.3f},
    {kPlantActuatorRate, "plant_actuator_rate", 1, 0.2f},
    {kPlantElevatorReached, "plant_elevator_reached", 0.35f, 0.2f},
    {kPlantAileronReached, "plant_aileron_reached", 0.35f, 0.2f},
    {kPlantRudderReached, "plant_rudder_reached", 0.35f, 0.2f},
    {kPlantActionDelay, "plant_action_delay", 0, 3},
    {kPlantObservationDelay, "plant_observation_delay", 0, 3},
    {kPlantIsFrozen, "plant_sensor_is_frozen", 0, 1}};

/// Fills rows column by column.
class RowWriter {
 public:
  RowWriter(int count, int size, float* rows) : count_(count), size_(size), rows_(rows) {}

  /// The next column: value(i) for every aircraft.
  template <typename Value>
  void Put(const Value& value) {
    for (int i = 0; i < count_; ++i) rows_[i * size_ + next_] = value(i);
    ++next_;
  }

 private:
  int count_, size_;
  float* rows_;
  int next_ = 0;
};

}  // namespace

std::vector<std::string> PrivilegedObservation::names() const {
  std::vector<std::string> names = {"task_error_0", "task_error_1", "task_error_2", "clock",
                                    "tolerance"};
  if (rules_.dwell_steps > 0) names.emplace_back("dwell");
  if (rules_.hold_steps > 0) names.emplace_back("reached");
  if (windy_) names.insert(names.end(), {"wind_x", "wind_y", "wind_z"});
  if (draws_plants_) {
    for (const PlantNumber& number : kPlantNumbers) names.emplace_back(number.name);
  }
  return names;
}

void PrivilegedObservation::Observe(const EnvBlock& block, float* rows) const {
  alignas(64) float errors[kNumTaskErrors * kAircraftPerBlock];
  task_.Errors(block.flight, block.task, errors, kAircraftPerBlock);
  RowWriter writer(block.count, size(), rows);
  for (int k = 0; k < kNumTaskErrors; ++k) {
    writer.Put([&](int i) { return errors[k * kAircraftPerBlock + i]; });
  }
  const float per_step = 1 / static_cast<float>(rules_.time_limit_steps);
  writer.Put([&](int i) { return per_step * static_cast<float>(block.step[i]); });
  writer.Put([&](int i) { return task_.ToleranceShare(block.task, i); });
  if (rules_.dwell_steps > 0) {
    const float per_dwell_step = 1 / static_cast<float>(rules_.dwell_steps);
    writer.Put([&](int i) {
      return std::min(1.0f, per_dwell_step * static_cast<float>(block.progress.steps_within[i]));
    });
  }
  if (rules_.hold_steps > 0) {
    writer.Put([&](int i) { return block.progress.reached_step[i] > 0 ? 1.0f : 0.0f; });
  }
  for (int k = 0; windy_ && k < 3; ++k) {
    const float *const ground = block.flight[kU + k], *const air = block.flight[kAirU + k];
    writer.Put([=](int i) { return (ground[i] - air[i]) * kPerWindFps; });
  }
  if (!draws_plants_) return;
  for (const PlantNumber& number : kPlantNumbers) {
    const float* const values = block.plants[number.column];
    writer.Put([&](int i) { return (values[i] - number.nominal) / number.unit; });
  }
}

}  // namespace skein
