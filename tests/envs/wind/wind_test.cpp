// SPDX-License-Identifier: Apache-2.0
#include "envs/wind/wind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "envs/actions.h"
#include "envs/tasks/observation.h"
#include "envs/vec_env.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr int kCount = 200;
constexpr double kInterval = 0.02;

EnvConfig Calm() {
  EnvConfig config;
  config.observation_noise = 0;
  return config;
}

EnvConfig Steady(double speed_fps, double from_deg, bool step_at_reset) {
  EnvConfig config = Calm();
  config.wind.speed_fps = {speed_fps, speed_fps};
  config.wind.from_deg = {from_deg, from_deg};
  config.wind.step_at_reset = step_at_reset;
  return config;
}

/// Flies every aircraft with the same gentle sticks.
void Fly(VecEnv* env, int policy_steps) {
  std::vector<float> action, reward(kCount), episode_return(kCount);
  for (int i = 0; i < kCount; ++i) action.insert(action.end(), {0.2f, 0.05f, 0.1f, 0});
  std::vector<std::uint8_t> termination(kCount);
  std::vector<std::int32_t> steps(kCount);
  for (int k = 0; k < policy_steps; ++k) {
    env->Step(0, action.data(),
              {reward.data(), termination.data(), episode_return.data(), steps.data()});
    for (const std::uint8_t end : termination) ASSERT_EQ(end, 0);
  }
}

std::vector<float> Observe(const VecEnv& env) {
  std::vector<float> observation(static_cast<std::size_t>(kCount) * kObservationSize);
  env.Observe(0, observation.data());
  return observation;
}

constexpr Tolerance kFloat32{1e-4, "float32 rounding of 100 ft/s"};

TEST(WindTest, BlowsFromWhereItIsSaidToComeFrom) {
  const VecEnv env(Steady(60, 270, true), kCount, 1, kCount);
  for (int i = 0; i < kCount; ++i) {
    EXPECT_NEAR(env.StateOf(i, kWindNorth), 0, kFloat32);
    EXPECT_NEAR(env.StateOf(i, kWindEast), 60, kFloat32);
    EXPECT_EQ(env.StateOf(i, kWindDown), 0);
  }
}

TEST(WindTest, EveryEpisodeDrawsItsOwn) {
  EnvConfig config = Calm();
  config.wind.speed_fps = {30, 120};
  config.wind.turbulence_fps = {1, 9};
  constexpr int kMany = 4000;
  const VecEnv env(config, kMany, 1, kMany);
  double sum = 0, north = 0, turbulence = 0;
  for (int i = 0; i < kMany; ++i) {
    const double n = env.StateOf(i, kSteadyWindNorth), e = env.StateOf(i, kSteadyWindEast);
    const double deviation = env.StateOf(i, kTurbulenceStdDev);
    EXPECT_GE(std::hypot(n, e), 30 - kFloat32);
    EXPECT_LE(std::hypot(n, e), 120 + kFloat32);
    EXPECT_GE(deviation, 1);
    EXPECT_LE(deviation, 9);
    sum += std::hypot(n, e) / kMany;
    north += n / kMany;
    turbulence += deviation / kMany;
  }
  // The deviations are 90 and 8 over sqrt(12), 80 over sqrt(2).
  EXPECT_NEAR(sum, 75, kStandardErrors * 26 / std::sqrt(kMany));
  EXPECT_NEAR(turbulence, 5, kStandardErrors * 2.4 / std::sqrt(kMany));
  EXPECT_NEAR(north, 0, kStandardErrors * 57 / std::sqrt(kMany));
}

TEST(WindTest, StillAirHasNone) {
  const VecEnv env(Calm(), kCount, 1, kCount);
  for (int column = kNumColumns; column < kNumWindyColumns; ++column) {
    EXPECT_EQ(env.StateOf(3, column), 0);
  }
}

TEST(WindTest, TurbulenceByAltitudeIsThatOfTheStandard) {
  constexpr Tolerance kRatio{1e-5, "float32 rounding, relative"};
  EnvConfig uniform = Calm();
  uniform.initial.altitude_ft = {35000, 35000};
  uniform.wind.turbulence_fps = {7.3, 7.3};
  EnvConfig by_altitude = uniform;
  by_altitude.wind.turbulence_by_altitude = true;
  const VecEnv same(uniform, kCount, 1, kCount), weaker(by_altitude, kCount, 1, kCount);
  for (int i = 0; i < kCount; ++i) {
    const double ratio = weaker.StateOf(i, kWindDown) / same.StateOf(i, kWindDown);
    EXPECT_NEAR(ratio / (5.0 / 7.3), 1, kRatio);
  }
}

// Galileo: nothing but the position tells a steady wind from still air.
TEST(WindTest, FlightTrimmedInTheWindIsFlightInStillAirCarriedAway) {
  constexpr Tolerance kTurnedAxes{1e-6, "float32 rounding of the same start"};
  constexpr Tolerance kAmplified{1e-4, "five seconds of rounding in other places"};
  constexpr Tolerance kPositions{0.05, "positions of 6000 ft, rounded by 5e-4 ft at every step"};
  constexpr int kSteps = 250;
  constexpr double kNorth20 = -100 * 0.93969262, kEast20 = -100 * 0.34202014;  // from 20 deg
  VecEnv calm(Calm(), kCount, 1, kCount), windy(Steady(100, 20, false), kCount, 1, kCount);
  const auto compare = [&](double tolerance) {
    const std::vector<float> expected = Observe(calm), actual = Observe(windy);
    for (std::size_t k = 0; k < expected.size(); ++k) {
      ASSERT_NEAR(actual[k], expected[k], tolerance) << "element " << k % kObservationSize;
    }
  };
  compare(kTurnedAxes);
  Fly(&calm, kSteps);
  Fly(&windy, kSteps);
  compare(kAmplified);
  for (int i = 0; i < kCount; ++i) {
    const double seconds = kSteps * kInterval;
    EXPECT_NEAR(windy.StateOf(i, kNorth) - calm.StateOf(i, kNorth), kNorth20 * seconds, kPositions);
    EXPECT_NEAR(windy.StateOf(i, kEast) - calm.StateOf(i, kEast), kEast20 * seconds, kPositions);
    EXPECT_NEAR(windy.StateOf(i, kDown), calm.StateOf(i, kDown), kPositions);
  }
}

TEST(WindTest, AStepAtResetKeepsTheVelocityOverGround) {
  constexpr Tolerance kSpeed{1e-3, "float32 rounding of errors in units of 340 m/s"};
  const VecEnv calm(Calm(), kCount, 1, kCount), windy(Steady(60, 0, true), kCount, 1, kCount);
  const std::vector<float> before = Observe(calm), after = Observe(windy);
  for (int i = 0; i < kCount; ++i) {
    for (int column = 0; column < kNumColumns; ++column) {
      ASSERT_EQ(windy.StateOf(i, column), calm.StateOf(i, column));
    }
    EXPECT_EQ(windy.TargetOf(i), calm.TargetOf(i));
    // All fly north into it: 60 ft/s more of true airspeed, which Heading's speed error shows.
    const std::size_t speed_error = static_cast<std::size_t>(i) * kObservationSize + 2;
    EXPECT_NEAR((before[speed_error] - after[speed_error]) * 340 / 0.3048, 60, kSpeed);
  }
}

TEST(WindTest, TurbulenceIsFeltAndSteadyWindIsNot) {
  EnvConfig rough = Calm();
  rough.wind.turbulence_fps = {7.3, 7.3};
  VecEnv steady(Steady(100, 20, false), kCount, 1, kCount), turbulent(rough, kCount, 1, kCount);
  double calm_square = 0, rough_square = 0;
  for (int k = 0; k < 50; ++k) {
    Fly(&steady, 1);
    Fly(&turbulent, 1);
    for (int i = 0; i < kCount; ++i) {
      calm_square += std::pow(steady.StateOf(i, kNz) - steady.StateOf(0, kNz), 2);
      rough_square += std::pow(turbulent.StateOf(i, kNz) - turbulent.StateOf(0, kNz), 2);
    }
  }
  EXPECT_GT(rough_square, 10 * calm_square);
}

}  // namespace
}  // namespace skein
