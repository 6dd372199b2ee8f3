// SPDX-License-Identifier: Apache-2.0
// EnvConfig::draw_power: how episodes' draws lie in their ranges.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "envs/env_config.h"
#include "envs/state/state.h"
#include "envs/vec_env.h"
#include "tests/envs/step_buffers.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr int kAircraft = 4096;
constexpr Tolerance kMedian{0.035, "of the range: 4.5 standard errors of a median, 1 / 128 each"};

EnvConfig StillFlight(int draw_power) {
  EnvConfig config;
  config.draw_power = draw_power;
  config.initial.trimmed = false;
  config.initial.altitude_ft = {20000, 20000};
  config.initial.true_airspeed_fps = {1000, 1000};
  config.observation_noise = 0;
  return config;
}

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// Of a state's column in first episodes.
double MedianOf(const EnvConfig& config, int column) {
  const VecEnv env(config, kAircraft, 5);
  std::vector<double> values;
  for (int i = 0; i < kAircraft; ++i) values.push_back(env.StateOf(i, column));
  return Median(values);
}

/// Mean square of what first observations of the roll rate, which is 0, show.
double SquareOfRollRate(const EnvConfig& config) {
  constexpr int kRollRate = 13;
  const VecEnv env(config, kAircraft, 5, kAircraft);
  StepBuffers buffers(kAircraft);
  env.Observe(0, buffers.observation.data());
  double sum = 0;
  for (int i = 0; i < kAircraft; ++i) {
    const double seen =
        buffers.observation[static_cast<std::size_t>(i * kObservationSize) + kRollRate];
    sum += seen * seen;
  }
  return sum / kAircraft;
}

class DrawPower : public testing::TestWithParam<int> {
 protected:
  int power() const { return GetParam(); }
  /// The mean of u^exponent.
  static double MeanPower(int exponent) { return 1.0 / (exponent + 1); }
  double half() const { return 1.0 / (1 << power()); }  ///< the median of u^power
};

TEST_P(DrawPower, BendsStartsTowardsTheLeast) {
  EnvConfig config = StillFlight(power());
  config.initial.altitude_ft = {20000, 30000};
  config.initial.true_airspeed_fps = {800, 1200};
  EXPECT_NEAR(-MedianOf(config, kDown), 20000 + 10000 * half(), 10000 * kMedian);
  EXPECT_NEAR(MedianOf(config, kU), 800 + 400 * half(), 400 * kMedian);
}

TEST_P(DrawPower, BendsTurbulenceTowardsTheLeast) {
  EnvConfig config = StillFlight(power());
  config.wind.turbulence_fps = {4, 24};
  EXPECT_NEAR(MedianOf(config, kTurbulenceStdDev), 4 + 20 * half(), 20 * kMedian);
}

TEST_P(DrawPower, BendsNoiseTowardsTheLeast) {
  EnvConfig config = StillFlight(power());
  config.observation_noise_max = 0.1;
  const double expected = 0.01 * MeanPower(2 * power());
  EXPECT_NEAR(SquareOfRollRate(config), expected, 0.1 * expected);
}

TEST_P(DrawPower, NarrowsPlantsAroundTheNominalOne) {
  EnvConfig config = StillFlight(power());
  config.plant.sensor_bias = 0.1;  // uniform in +-0.1 u^(power - 1)
  const double expected = 0.01 / 3 * MeanPower(2 * (power() - 1));
  EXPECT_NEAR(SquareOfRollRate(config), expected, 0.1 * expected);
}

INSTANTIATE_TEST_SUITE_P(Powers, DrawPower, testing::Values(1, 2, 3));

TEST(NoiseOfTraining, IsThatOfTheSameRangeAndNoneOfEvaluations) {
  EnvConfig plain = StillFlight(1), silent = plain;
  silent.training_noise_max = 0.1;
  EXPECT_EQ(SquareOfRollRate(silent), 0) << "0 is no noise";
  plain.observation_noise = 0.01;
  EnvConfig noisy = plain, noisier_in_training = plain;
  noisy.observation_noise_max = noisier_in_training.training_noise_max = 0.1;
  EXPECT_EQ(SquareOfRollRate(noisier_in_training), SquareOfRollRate(noisy));
  EXPECT_EQ(SquareOfRollRate(EvaluationConfig(noisier_in_training)), SquareOfRollRate(plain));
  EXPECT_GT(SquareOfRollRate(noisy), SquareOfRollRate(plain));
}

TEST(DrawPowerOfTraining, IsNoneOfEvaluations) {
  EXPECT_EQ(EvaluationConfig(StillFlight(3)).draw_power, 1);
}

}  // namespace
}  // namespace skein
