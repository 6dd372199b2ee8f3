// SPDX-License-Identifier: Apache-2.0
#include "envs/plant/sensor_freeze.h"

#include <algorithm>

#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/plant/sensor_freeze.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

/// Whether an aircraft's step comes to its freeze step within `ahead` steps. Of padding both are
/// sound numbers, too.
bool AnyComes(const float* freeze_step, const std::int32_t* step, int ahead, int count) {
  const FloatTag d;
  const IntTag di;
  const V later = hn::Set(d, static_cast<float>(ahead));
  auto any = hn::MaskFromVec(hn::Zero(d));
  for (int first = 0; first < count; first += kLanes) {
    const V last = hn::Add(hn::ConvertTo(d, hn::LoadU(di, step + first)), later);
    any = hn::Or(any, hn::Ge(last, hn::LoadU(d, freeze_step + first)));
  }
  return !hn::AllFalse(d, any);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(AnyComes);

namespace {

bool Freezes(const PlantTile& plants, int i, const std::int32_t* step) {
  return static_cast<float>(step[i]) >= plants[kPlantFreezeStep][i];
}

const FreezingSensor& SensorOf(const PlantTile& plants, int i) {
  // A snapshot that was restored may hold any number, or NaN.
  const float index = plants[kPlantFrozenSensor][i];
  return kFreezingSensors[index > 0 ? static_cast<int>(std::min(index, kNumFreezingSensors - 1.0f))
                                    : 0];
}

}  // namespace

bool AnySensorFreezes(const PlantTile& plants, int count, const std::int32_t* step, int ahead) {
  return SKEIN_DISPATCH(AnyComes)(plants[kPlantFreezeStep], step, ahead, count);
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

void ShowFrozenSensor(const PlantTile& plants, int i, float* row) {
  const FreezingSensor& sensor = SensorOf(plants, i);
  for (int k = 0; k < sensor.count; ++k) row[sensor.first + k] = plants[kPlantHeld + k][i];
}

}  // namespace skein
#endif
