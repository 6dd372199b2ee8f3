// SPDX-License-Identifier: Apache-2.0
#include "train/measures/hold_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr double kInterval = 0.02;
constexpr double kDegrees = 180 / M_PI;
constexpr Tolerance kFloat{2e-6, "float32 rounding"};

/// Of the states at 0.02, 0.04, ... s, `steps` of them.
HoldMetrics Measure(const std::function<HeldState(double)>& state, int steps, double asked_s = 0) {
  HoldSums sums;
  for (int i = 1; i <= steps; ++i) sums.Add(state(i * kInterval));
  return sums.Report(kInterval, asked_s);
}

HoldMetrics Roll(const std::function<double(double)>& roll_rad, int steps) {
  return Measure(
      [&](double t) {
        HeldState state;
        state.roll_rad = std::remainder(roll_rad(t), 2 * M_PI);
        return state;
      },
      steps);
}

TEST(HoldMetricsTest, ASteadyRollOfTwelveAMinuteIsTwelveNetRolls) {
  const double rate = 12 * 2 * M_PI / 60;
  for (const double direction : {1.0, -1.0}) {
    // Half a minute, and a time that is no whole number of rolls.
    for (const int steps : {1500, 1234}) {
      const HoldMetrics rolling = Roll([=](double t) { return direction * rate * t; }, steps);
      EXPECT_NEAR(rolling.net_rolls_per_min, 12, 12 * kFloat);
    }
  }
  // Roll angles are spread evenly over a circle.
  EXPECT_NEAR(Roll([=](double t) { return rate * t; }, 1500).mean_abs_bank, 90, 90 * kFloat);
}

TEST(HoldMetricsTest, ABarrelRollBackAndForthCancels) {
  const auto back_and_forth = [](double t) {
    const double turns = t <= 15 ? t / 3 : (30 - t) / 3;
    return 2 * M_PI * turns;
  };
  // What is left is the way to the first state, at 0.02 s, which is not seen.
  EXPECT_NEAR(Roll(back_and_forth, 1500).net_rolls_per_min, kInterval / 3 / (1499 * kInterval / 60),
              kFloat);
  EXPECT_NEAR(
      Roll([](double t) { return 0.5 * std::sin(t * 2 * M_PI / 2); }, 1501).net_rolls_per_min, 0,
      kFloat);
}

TEST(HoldMetricsTest, WhatLiesBetweenStretchesDoesNotRoll) {
  HoldSums sums;
  HeldState state;
  for (int stretch = 0; stretch < 4; ++stretch) {
    for (int i = 0; i <= 10; ++i) {
      state.roll_rad = stretch + 0.001 * i;
      sums.Add(state);
    }
    sums.Break();
  }
  const double rolls = 4 * 0.01 / (2 * M_PI), minutes = 40 * kInterval / 60;
  EXPECT_NEAR(sums.Report(kInterval, 0).net_rolls_per_min, rolls / minutes,
              rolls / minutes * kFloat);
}

TEST(HoldMetricsTest, RmsOfASineIsItsAmplitudeByTheRootOfTwo) {
  const HoldMetrics metrics = Measure(
      [](double t) {
        const double sine = std::sin(2 * M_PI * t);
        HeldState state;
        state.errors = {static_cast<float>(0.2 * sine), 0.5f, static_cast<float>(-0.1 * sine)};
        state.p_rad_s = 0.3 * sine;
        state.q_rad_s = -0.1;
        state.r_rad_s = 0.05 * sine;
        state.sideslip_rad = 0.02 * sine;
        state.load_factor = 1 + 0.4 * sine;
        return state;
      },
      500);
  const double root = std::sqrt(2);
  EXPECT_NEAR(metrics.rms_errors[0], 0.2 / root, kFloat);
  EXPECT_EQ(metrics.rms_errors[1], 0.5f);
  EXPECT_NEAR(metrics.rms_errors[2], 0.1 / root, kFloat);
  EXPECT_NEAR(metrics.rms_p, 0.3 / root * kDegrees, 100 * kFloat);
  EXPECT_NEAR(metrics.rms_q, 0.1 * kDegrees, 100 * kFloat);
  EXPECT_NEAR(metrics.rms_r, 0.05 / root * kDegrees, 100 * kFloat);
  EXPECT_NEAR(metrics.rms_sideslip, 0.02 / root * kDegrees, 100 * kFloat);
  EXPECT_NEAR(metrics.load_factor_deviation, 0.4 / root, kFloat) << "about its mean, 1";
}

TEST(HoldMetricsTest, WhatWasNotFlownWasNotWithin) {
  const auto first_ten = [](double t) {
    HeldState state;
    state.is_within = t < 10.01;
    return state;
  };
  EXPECT_FLOAT_EQ(Measure(first_ten, 1500, 30).within, 1 / 3.0f);
  EXPECT_FLOAT_EQ(Measure(first_ten, 1000, 30).within, 1 / 3.0f) << "lost after 20 s";
  EXPECT_FLOAT_EQ(Measure(first_ten, 1000).within, 0.5f) << "of what was flown";
}

TEST(HoldMetricsTest, WithoutStatesThereIsNothingButTheTimeNotHeld) {
  const HoldMetrics lost = HoldSums().Report(kInterval, 30), none = HoldSums().Report(kInterval, 0);
  EXPECT_EQ(lost.within, 0);
  EXPECT_TRUE(std::isnan(lost.rms_p));
  EXPECT_TRUE(std::isnan(none.within));
  EXPECT_TRUE(std::isnan(Measure([](double) { return HeldState(); }, 1).net_rolls_per_min));
}

}  // namespace
}  // namespace skein
