// SPDX-License-Identifier: Apache-2.0
#include "envs/plant/sensor_freeze.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "envs/tasks/observation.h"

namespace skein {
namespace {

/// A vector of plants, every column at 0.
class SensorFreeze : public testing::Test {
 protected:
  static constexpr int kStride = 16;

  PlantTile plants() { return {{columns_.data(), kStride, kStride}}; }

  std::vector<float> columns_ = std::vector<float>(kNumPlantColumnsWithSensors * kStride);
};

TEST_F(SensorFreeze, NoClockComesToASensorThatNeverFreezes) {
  std::array<std::int32_t, kStride> last_steps;
  last_steps.fill(std::numeric_limits<std::int32_t>::max());
  for (int i = 0; i < kStride; ++i) {
    plants()[kPlantFrozenSensor][i] = -1;
    plants()[kPlantFreezeStep][i] = kNeverFreezes;
  }
  const std::vector<float> before = columns_;
  const std::vector<float> observations(kStride * kObservationSize, 1);
  EXPECT_FALSE(AnySensorFreezes(plants(), kStride, last_steps.data(), 0));
  FreezeSensors(plants(), kStride, last_steps.data(), observations.data(), kObservationSize);
  EXPECT_EQ(columns_, before);
}

TEST_F(SensorFreeze, WhateverASnapshotHoldsIsOneOfTheSensors) {
  for (const float index : {-1.0f, 7.0f, 1e6f, -1e30f, std::numeric_limits<float>::infinity(),
                            std::numeric_limits<float>::quiet_NaN()}) {
    plants()[kPlantFrozenSensor][0] = index;
    plants()[kPlantHeld][0] = plants()[kPlantHeldSecond][0] = 5;
    std::vector<float> row(kObservationSize);  // a sanitizer sees what is written beyond it
    ShowFrozenSensor(plants(), 0, row.data());
    const auto shown = std::count(row.begin(), row.end(), 5.0f);
    EXPECT_TRUE(shown == 1 || shown == 2) << index << ": " << shown;
  }
}

}  // namespace
}  // namespace skein
