// SPDX-License-Identifier: Apache-2.0
// Delays and sensors that are drawn act as they are called, in flights of the environment.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "envs/aircraft/engine.h"
#include "envs/aircraft/f16.h"
#include "envs/plant/plant_draw.h"
#include "envs/vec_env.h"
#include "tests/envs/plant/one_flight.h"
#include "tests/envs/step_buffers.h"
#include "tests/tolerance.h"

namespace skein::one_flight {
namespace {

TEST(DrawnSensing, AnActionDelayOfKStepsShiftsTheCommandsByK) {
  constexpr Tolerance kThrottle{2e-5, "float32 of the trim's throttle, 40 steps on, relative"};
  for (const int delay : {1, 2, 3}) {
    EnvConfig late = OneFlight();
    late.plant.action_delay_steps = {delay, delay};
    const float trim = VecEnv(OneFlight(), 1, 1).StateOf(0, kPower);
    const auto throttle = static_cast<float>(
        2 * ThrottleForPower(F16().throttle_gearing, static_cast<double>(trim)) - 1);
    const auto shifted = [&](int step) {
      return step < delay ? Action{throttle, 0, 0, 0} : Lively(step - delay);
    };
    const auto expected = Fly(OneDrawnFlight(), shifted, 40), flown = Fly(late, Lively, 40);
    for (std::size_t k = 0; k < flown.size(); ++k) {
      ASSERT_NEAR(flown[k], expected[k], kThrottle * (1 + std::abs(expected[k])))
          << delay << ", " << k;
    }
  }
}

/// Observations before each of `steps` control steps.
std::vector<std::array<float, kObservationSize>> Observe(const EnvConfig& config, int steps) {
  VecEnv env(config, 1, 1);
  StepBuffers buffers(1);
  std::vector<std::array<float, kObservationSize>> rows(static_cast<std::size_t>(steps));
  for (int step = 0; step < steps; ++step) {
    env.Observe(0, rows[static_cast<std::size_t>(step)].data());
    const Action action = Lively(step);
    std::copy(action.begin(), action.end(), buffers.action.begin());
    env.Step(0, buffers.action.data(), buffers.output());
  }
  return rows;
}

void ExpectDelayedObservations(const EnvConfig& nominal) {
  constexpr std::size_t kSteps = 30;
  const auto prompt = Observe(nominal, kSteps);
  for (const std::size_t delay : {1u, 2u, 3u}) {
    EnvConfig late = nominal;
    late.plant.observation_delay_steps = {static_cast<int>(delay), static_cast<int>(delay)};
    const auto seen = Observe(late, kSteps);
    for (std::size_t step = 0; step < kSteps; ++step) {
      EXPECT_EQ(seen[step], prompt[step < delay ? 0 : step - delay])
          << nominal.task << ", " << delay << ", " << step;
    }
  }
}

TEST(DrawnSensing, AnObservationDelayOfKStepsShowsTheStateOfKStepsAgo) {
  for (const bool windy : {false, true}) {
    EnvConfig nominal = OneDrawnFlight();
    if (windy) nominal.wind.turbulence_fps = {10, 10};
    for (const char* task : {"heading", "control"}) {
      nominal.task = task;
      ExpectDelayedObservations(nominal);
    }
    nominal.task = "tracking";
    for (const TrackingAxes axes : {TrackingAxes::kHeading, TrackingAxes::kPath}) {
      nominal.tracking.error_axes = axes;
      ExpectDelayedObservations(nominal);
    }
  }
}

TEST(DrawnSensing, SensorErrorsAreConstantAndLeaveTheTasksErrors) {
  constexpr double kMostBias = 0.05, kMostScale = 0.1;  // what may be drawn
  constexpr Tolerance kScale{0.101, "the largest error, and float32 rounding of a change of 0.01"};
  constexpr Tolerance kLine{1e-4, "float32 rounding of a change of 0.01, at changes of 1"};
  EnvConfig config = OneDrawnFlight();
  const auto exact = Observe(config, 20);
  config.plant.sensor_bias = kMostBias;
  config.plant.sensor_scale = kMostScale;
  const auto seen = Observe(config, 20);
  int different = 0;
  for (std::size_t k = 0; k < kObservationSize; ++k) {
    // The line through two of the points holds for all.
    const double change = exact[15][k] - exact[3][k];
    for (std::size_t step = 0; step < 20; ++step) {
      if (k < 3) {
        EXPECT_EQ(seen[step][k], exact[step][k]);
      } else {
        EXPECT_NEAR(seen[step][k], exact[step][k],
                    kMostBias + kMostScale * std::abs(exact[step][k]));
      }
    }
    if (k >= 3 && seen[0][k] != exact[0][k]) ++different;
    if (k < 3 || std::abs(change) < 0.01) continue;
    const double scale = (seen[15][k] - seen[3][k]) / change;
    EXPECT_NEAR(scale, 1, kScale) << k;
    for (std::size_t step = 0; step < 20; ++step) {
      EXPECT_NEAR(seen[step][k] - seen[3][k], scale * (exact[step][k] - exact[3][k]), kLine) << k;
    }
  }
  EXPECT_EQ(different, kObservationSize - 3);
}

TEST(DrawnSensing, SensorErrorsAreTheDrawnOnes) {
  EnvConfig config = OneDrawnFlight();
  const auto exact = Observe(config, 1);
  config.plant.sensor_bias = 0.05;
  config.plant.sensor_scale = 0.1;
  const auto seen = Observe(config, 1);
  simd::RandomStream random({1, 0, 0, 0, simd::RandomPurpose::kPlant});
  const PlantDraw draw = DrawPlant(config.plant, &random);
  constexpr Tolerance kPacked{1.0 / 128, "what packing rounds off each error, relative"};
  constexpr Tolerance kRounding{1e-6, "float32 rounding of numbers up to some units"};
  for (std::size_t k = 3; k < kObservationSize; ++k) {
    const double value = exact[0][k];
    const double by_scale = value * draw.sensor_scale[k - 3], bias = draw.sensor_bias[k - 3];
    EXPECT_NEAR(seen[0][k], value + by_scale + bias,
                kPacked * (std::abs(by_scale) + std::abs(bias)) + kRounding)
        << k;
  }
}

TEST(DrawnSensing, AFrozenSensorShowsWhatItLastShowed) {
  constexpr int kCount = 64, kSteps = 20, kFrozen = 5;
  EnvConfig config = OneFlight();
  config.observation_noise = 0.01;
  config.plant.sensor_freeze_chance = 1;
  config.plant.sensor_freeze_s = {kFrozen * kInterval, kFrozen * kInterval};
  VecEnv env(config, kCount, 1);
  StepBuffers buffers(kCount);
  std::vector<std::vector<float>> seen;
  for (int step = 0; step < kSteps; ++step) {
    env.Observe(0, buffers.observation.data());
    seen.push_back(buffers.observation);
    env.Step(0, buffers.action.data(), buffers.output());
  }
  std::array<int, kObservationSize> frozen{};
  for (int i = 0; i < kCount; ++i) {
    int numbers = 0;
    for (int k = 0; k < kObservationSize; ++k) {
      const auto at = [&](int step) {
        return seen[static_cast<std::size_t>(step)]
                   [static_cast<std::size_t>(i * kObservationSize + k)];
      };
      bool is_constant = true;
      for (int step = kFrozen; step < kSteps; ++step) is_constant &= at(step) == at(kFrozen);
      EXPECT_NE(at(kFrozen - 1), at(kFrozen)) << "noise is new every step";
      numbers += is_constant;
      frozen[static_cast<std::size_t>(k)] += is_constant;
    }
    EXPECT_GE(numbers, 1) << i;
    EXPECT_LE(numbers, 2) << i;
  }
  for (const FreezingSensor& sensor : kFreezingSensors) {
    EXPECT_GT(frozen[static_cast<std::size_t>(sensor.first)], 0) << sensor.first;
  }
  for (const std::size_t k : {0u, 1u, 2u, 4u, 5u, 6u, 7u}) EXPECT_EQ(frozen[k], 0) << k;
}

void ExpectHeldActionsAreTheSameInEveryControlStep(EnvConfig config) {
  constexpr int kCount = 64, kPolicySteps = 12;
  config.observation_noise = 0.01;
  config.plant.sensor_bias = 0.02;
  config.plant.sensor_freeze_chance = 0.5;
  config.plant.sensor_freeze_s = {5 * kInterval, 40 * kInterval};
  for (const int longest : {1, 2, 7}) {
    config.plant.action_delay_steps = config.plant.observation_delay_steps = {0, longest};
    EnvConfig held = config;
    held.action_repeat = 5;
    VecEnv once(held, kCount, 1), again(config, kCount, 1);
    StepBuffers buffers(kCount), others(kCount);
    for (int step = 0; step < kPolicySteps; ++step) {
      once.Observe(0, buffers.observation.data());
      again.Observe(0, others.observation.data());
      ASSERT_EQ(buffers.observation, others.observation) << longest << ", " << step;
      const Action action = Lively(step);
      for (std::size_t i = 0; i < kCount; ++i) {
        std::copy(action.begin(), action.end(), buffers.action.begin() + 4 * i);
      }
      once.Step(0, buffers.action.data(), buffers.output());
      for (int k = 0; k < held.action_repeat; ++k) {
        again.Step(0, buffers.action.data(), others.output());
      }
    }
  }
}

TEST(DrawnSensing, AHeldActionIsTheSameActionInEveryControlStep) {
  EnvConfig config = OneDrawnFlight();
  ExpectHeldActionsAreTheSameInEveryControlStep(config);
  config.task = "tracking";  // whose delayed states are those of a point and, now, of wind
  config.wind.turbulence_fps = {10, 10};
  ExpectHeldActionsAreTheSameInEveryControlStep(config);
}

}  // namespace
}  // namespace skein::one_flight
