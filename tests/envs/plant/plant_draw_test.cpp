// SPDX-License-Identifier: Apache-2.0
#include "envs/plant/plant_draw.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <set>
#include <vector>

#include "base/error.h"
#include "envs/env_config.h"
#include "tests/extremes.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr int kDraws = 3000;

std::vector<PlantDraw> Draws(const PlantConfig& config, std::uint64_t seed = 1) {
  std::vector<PlantDraw> draws;
  for (int i = 0; i < kDraws; ++i) {
    simd::RandomStream random(
        {seed, static_cast<std::uint32_t>(i), 0, 0, simd::RandomPurpose::kPlant});
    draws.push_back(DrawPlant(config, &random));
  }
  return draws;
}

TEST(PlantDraw, FillsItsRangesAndNothingBeyond) {
  PlantConfig config;
  config.mass = {0.9, 1.1};
  config.engine_momentum = {0, 160};
  double least = 2, most = 0, least_momentum = 160, most_momentum = 0;
  for (const PlantDraw& draw : Draws(config)) {
    least = Smaller(least, draw.mass);
    most = Larger(most, draw.mass);
    least_momentum = Smaller(least_momentum, draw.engine_momentum);
    most_momentum = Larger(most_momentum, draw.engine_momentum);
  }
  constexpr double kShare = 0.01;  // of the range: 3000 draws leave less
  EXPECT_GE(least, 0.9);
  EXPECT_LT(least, 0.9 + kShare * 0.2);
  EXPECT_LE(most, 1.1);
  EXPECT_GT(most, 1.1 - kShare * 0.2);
  EXPECT_GE(least_momentum, 0);
  EXPECT_LT(least_momentum, kShare * 160);
  EXPECT_GT(most_momentum, (1 - kShare) * 160);
}

/// A quantity that is drawn from a range, in its configuration and in what is drawn.
struct Quantity {
  const char* name;
  Range PlantConfig::*range;
  double PlantDraw::*value;
};

/// Without what the three surfaces share.
constexpr Quantity kQuantities[] = {
    {"mass", &PlantConfig::mass, &PlantDraw::mass},
    {"inertia", &PlantConfig::inertia, &PlantDraw::inertia},
    {"cg_shift", &PlantConfig::cg_shift, &PlantDraw::cg_shift},
    {"axial_force", &PlantConfig::axial_force, &PlantDraw::axial_force},
    {"normal_force", &PlantConfig::normal_force, &PlantDraw::normal_force},
    {"pitching_moment", &PlantConfig::pitching_moment, &PlantDraw::pitching_moment},
    {"lateral", &PlantConfig::lateral, &PlantDraw::lateral},
    {"damping", &PlantConfig::damping, &PlantDraw::damping},
    {"thrust", &PlantConfig::thrust, &PlantDraw::thrust},
    {"thrust_lag", &PlantConfig::thrust_lag, &PlantDraw::thrust_lag},
    {"engine_momentum", &PlantConfig::engine_momentum, &PlantDraw::engine_momentum},
    {"density", &PlantConfig::density, &PlantDraw::density},
    {"pitch_stick", &PlantConfig::pitch_stick, &PlantDraw::pitch_stick},
    {"roll_stick", &PlantConfig::roll_stick, &PlantDraw::roll_stick},
    {"yaw_stick", &PlantConfig::yaw_stick, &PlantDraw::yaw_stick},
    {"actuator_rate", &PlantConfig::actuator_rate, &PlantDraw::actuator_rate},
    {"actuator_bandwidth", &PlantConfig::actuator_bandwidth, &PlantDraw::actuator_bandwidth},
};

TEST(PlantDraw, QuantitiesAreUniformAndIndependent) {
  PlantConfig config;
  for (const Quantity& quantity : kQuantities) config.*quantity.range = {0.5, 1.5};
  const std::vector<PlantDraw> draws = Draws(config);
  // Of uniform numbers less their mean: variance 1/12, and of their squares 1/180.
  const double error_of_mean = kStandardErrors / std::sqrt(12.0 * kDraws);
  const double error_of_variance = kStandardErrors / std::sqrt(180.0 * kDraws);
  const double error_of_covariance = kStandardErrors / (12 * std::sqrt(double{kDraws}));
  for (const Quantity& one : kQuantities) {
    double sum = 0;
    for (const PlantDraw& draw : draws) sum += draw.*one.value - 1;
    EXPECT_NEAR(sum / kDraws, 0, error_of_mean) << one.name;
    for (const Quantity& other : kQuantities) {
      double products = 0;
      for (const PlantDraw& draw : draws) {
        products += (draw.*one.value - 1) * (draw.*other.value - 1);
      }
      const bool is_same = &one == &other;
      EXPECT_NEAR(products / kDraws, is_same ? 1.0 / 12 : 0,
                  is_same ? error_of_variance : error_of_covariance)
          << one.name << ", " << other.name;
    }
  }
}

TEST(PlantDraw, WhatIsNotAskedForIsNominal) {
  const PlantDraw nominal;
  for (const PlantDraw& draw : Draws(PlantConfig())) {
    EXPECT_EQ(draw.mass, 1);
    EXPECT_EQ(draw.cg_shift, 0);
    EXPECT_EQ(draw.elevator, 1);
    EXPECT_EQ(draw.aileron, 1);
    EXPECT_EQ(draw.rudder, 1);
    EXPECT_EQ(draw.action_delay_steps, 0);
    EXPECT_EQ(draw.observation_delay_steps, 0);
    EXPECT_EQ(draw.frozen_sensor, -1);
    EXPECT_EQ(draw.sensor_bias, nominal.sensor_bias);
    EXPECT_EQ(draw.sensor_scale, nominal.sensor_scale);
  }
}

TEST(PlantDraw, AQuantityDoesNotDependOnOthersRanges) {
  PlantConfig one;
  one.damping = {0.5, 1.5};
  PlantConfig many = one;
  many.mass = {0.5, 2};
  many.weak_surface = {0.2, 1};
  many.action_delay_steps = {0, 3};
  many.sensor_freeze_chance = 0.5;
  const std::vector<PlantDraw> few = Draws(one), all = Draws(many);
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i].damping, all[i].damping);
}

TEST(PlantDraw, DelaysAreWholeAndEachAsLikely) {
  PlantConfig config;
  config.action_delay_steps = {1, 3};
  std::vector<int> counts(5, 0);
  for (const PlantDraw& draw : Draws(config)) {
    ++counts[static_cast<std::size_t>(draw.action_delay_steps)];
  }
  EXPECT_EQ(counts[0], 0);
  EXPECT_EQ(counts[4], 0);
  // A third of the draws, with a standard error of sqrt(n / 3 * 2 / 3).
  const double error = kStandardErrors * std::sqrt(kDraws * 2.0 / 9);
  for (int delay = 1; delay <= 3; ++delay) {
    EXPECT_NEAR(counts[static_cast<std::size_t>(delay)], kDraws / 3.0, error);
  }
}

TEST(PlantDraw, OneSurfaceIsWeak) {
  PlantConfig config;
  config.control = {0.8, 0.8};
  config.weak_surface = {0.5, 0.5};
  std::vector<int> counts(3, 0);
  for (const PlantDraw& draw : Draws(config)) {
    const double surfaces[] = {draw.elevator, draw.aileron, draw.rudder};
    int weak = 0;
    for (int k = 0; k < 3; ++k) {
      if (surfaces[k] < 0.6) {
        EXPECT_DOUBLE_EQ(surfaces[k], 0.4);
        ++weak;
        ++counts[static_cast<std::size_t>(k)];
      } else {
        EXPECT_DOUBLE_EQ(surfaces[k], 0.8);
      }
    }
    EXPECT_EQ(weak, 1);
  }
  const double error = kStandardErrors * std::sqrt(kDraws * 2.0 / 9);
  for (const int count : counts) EXPECT_NEAR(count, kDraws / 3.0, error);
}

TEST(PlantDraw, SensorsFreezeAsOftenAsAskedForAndAreAllAmongThem) {
  PlantConfig config;
  config.sensor_freeze_chance = 0.2;
  config.sensor_freeze_s = {5, 10};
  int frozen = 0;
  std::set<int> sensors;
  for (const PlantDraw& draw : Draws(config)) {
    if (draw.frozen_sensor < 0) continue;
    ++frozen;
    sensors.insert(draw.frozen_sensor);
    EXPECT_GE(draw.freeze_s, 5);
    EXPECT_LE(draw.freeze_s, 10);
  }
  EXPECT_NEAR(frozen, 0.2 * kDraws, kStandardErrors * std::sqrt(0.16 * kDraws));
  EXPECT_EQ(sensors.size(), static_cast<std::size_t>(kNumFreezingSensors));
}

TEST(PlantDraw, PackedSensorErrorsAreRoundedTowardsZero) {
  PlantConfig config;
  config.sensor_scale = 0.03;
  config.sensor_bias = 0.01;
  const auto half = [](std::uint32_t bits) {
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return static_cast<double>(value);
  };
  const auto expect_rounded = [](double packed, double drawn) {
    EXPECT_LE(std::abs(packed), std::abs(drawn));
    EXPECT_NEAR(packed, drawn, std::abs(drawn) / 128);
  };
  for (const PlantDraw& draw : Draws(config)) {
    const float packed = PackSensorError(draw.sensor_scale[0], draw.sensor_bias[0]);
    std::uint32_t bits = 0;
    std::memcpy(&bits, &packed, sizeof bits);
    expect_rounded(half(bits & 0xffff0000u), draw.sensor_scale[0]);
    expect_rounded(half(bits << 16), draw.sensor_bias[0]);
  }
}

TEST(PlantConfig, IsEnabledByEachOfItsQuantities) {
  PlantConfig config;
  EXPECT_FALSE(config.enabled());
  config.yaw_stick = {1, 1.1};
  EXPECT_TRUE(config.enabled());
  config = {};
  config.observation_delay_steps.max = 1;
  EXPECT_TRUE(config.enabled());
  config = {};
  config.sensor_bias = 0.01;
  EXPECT_TRUE(config.enabled());
  config = {};
  config.sensor_freeze_chance = 0.1;
  EXPECT_TRUE(config.enabled());
}

TEST(PlantConfig, RefusesRangesWhoseEndsAreExchanged) {
  EnvConfig config;
  config.plant.mass = {1.1, 0.9};
  EXPECT_THROW(Validate(config), Error);
  config.plant = {};
  config.plant.action_delay_steps = {2, 1};
  EXPECT_THROW(Validate(config), Error);
}

}  // namespace
}  // namespace skein
