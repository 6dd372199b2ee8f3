// SPDX-License-Identifier: Apache-2.0
#include "envs/plant/sensor_freeze.h"

namespace skein {
namespace {

bool Freezes(const PlantTile& plants, int i, const std::int32_t* step) {
  return static_cast<float>(step[i]) >= plants[kPlantFreezeStep][i];
}

const FreezingSensor& SensorOf(const PlantTile& plants, int i) {
  return kFreezingSensors[static_cast<int>(plants[kPlantFrozenSensor][i])];
}

}  // namespace

bool AnySensorFreezes(const PlantTile& plants, int count, const std::int32_t* step) {
  bool any = false;
  for (int i = 0; i < count; ++i) any |= Freezes(plants, i, step);
  return any;
}

void FreezeSensors(const PlantTile& plants, int count, const std::int32_t* step,
                   const float* observation, int observation_size) {
  for (int i = 0; i < count; ++i) {
    if (!Freezes(plants, i, step)) continue;
    const FreezingSensor& sensor = SensorOf(plants, i);
    for (int k = 0; k < sensor.count; ++k) {
      plants[kPlantHeld + k][i] = observation[i * observation_size + sensor.first + k];
    }
    plants[kPlantIsFrozen][i] = 1;
    plants[kPlantFreezeStep][i] = kNeverFreezes;
  }
}

void ShowFrozenSensors(const PlantTile& plants, int count, float* observation,
                       int observation_size) {
  for (int i = 0; i < count; ++i) {
    if (plants[kPlantIsFrozen][i] == 0) continue;
    const FreezingSensor& sensor = SensorOf(plants, i);
    for (int k = 0; k < sensor.count; ++k) {
      observation[i * observation_size + sensor.first + k] = plants[kPlantHeld + k][i];
    }
  }
}

}  // namespace skein
