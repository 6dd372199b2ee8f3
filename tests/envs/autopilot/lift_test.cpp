// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "envs/autopilot/lift-inl.h"
#include "gtest/gtest.h"
#include "tests/tolerance.h"

namespace skein {
namespace HWY_NAMESPACE {
namespace {

constexpr double kG = kGravityFtS2;

Kinematics<double> Banked(double roll) {
  Kinematics<double> motion = {};
  motion.sin_roll = std::sin(roll);
  motion.cos_roll = std::cos(roll);
  motion.cos_pitch = 1;
  return motion;
}

LiftGains OverBanking() {
  LiftGains gains;
  gains.over_bank = true;
  return gains;
}

TEST(Lift, LevelFlightNeedsOneG) {
  for (const LiftGains& gains : {LiftGains(), OverBanking()}) {
    const auto lift = PointLift(gains, Banked(0), 0.0, 0.0);
    EXPECT_EQ(lift.roll, 0);
    EXPECT_DOUBLE_EQ(lift.load_factor, 1);
  }
}

constexpr Tolerance kRounding{1e-12, "float64 rounding"};

/// A level turn: tan(bank) = a / g, n = 1 / cos(bank).
TEST(Lift, CoordinatesALevelTurn) {
  for (const LiftGains& gains : {LiftGains(), OverBanking()}) {
    const double bank = std::atan(3.0);
    const auto lift = PointLift(gains, Banked(bank), 3 * kG, 0.0);
    EXPECT_NEAR(lift.roll, bank, kRounding);
    EXPECT_NEAR(lift.load_factor, 1 / std::cos(bank), kRounding);
  }
}

TEST(Lift, IsSymmetric) {
  for (const LiftGains& gains : {LiftGains(), OverBanking()}) {
    for (const double vertical : {-100.0, 0.0, 50.0}) {
      const auto right = PointLift(gains, Banked(0.3), 100.0, vertical);
      const auto left = PointLift(gains, Banked(-0.3), -100.0, vertical);
      EXPECT_EQ(right.roll, -left.roll);
      EXPECT_EQ(right.load_factor, left.load_factor);
    }
  }
}

/// Whatever is asked, no more than the largest load factor is needed at the bank it asks for.
TEST(Lift, GivesTheVerticalPrecedenceWithinTheLoadFactor) {
  constexpr Tolerance kForceRounding{1e-6, "float64 rounding of differences of squares"};
  const LiftGains gains = OverBanking();
  for (const double vertical : {-130.0, 0.0, 100.0, 180.0}) {
    const double up = kG + vertical;
    const double used = std::min(up, gains.vertical_share * gains.max_load_factor * kG);
    const auto first = PointLift(gains, Banked(0), 1e4, vertical);
    const auto lift = PointLift(gains, Banked(first.roll), 1e4, vertical);
    EXPECT_LE(lift.load_factor, gains.max_load_factor);
    if (lift.load_factor < gains.max_load_factor) {
      EXPECT_NEAR(lift.load_factor * std::cos(lift.roll) * kG, used, kForceRounding);
    }
  }
}

TEST(Lift, KeepsWingsWithinTheBankUnlessItOverBanks) {
  LiftGains gains;
  gains.max_bank = Radians(45);
  EXPECT_DOUBLE_EQ(PointLift(gains, Banked(0), 1e4, 0.0).roll, Radians(45));
  EXPECT_GT(PointLift(OverBanking(), Banked(0), 200.0, -130.0).roll, M_PI / 2);
}

TEST(Lift, LevelsTheWingsToPushOver) {
  EXPECT_EQ(PointLift(LiftGains(), Banked(0.5), 50.0, -130.0).roll, 0);
  EXPECT_LT(PointLift(LiftGains(), Banked(0), 50.0, -130.0).load_factor, 0);
}

TEST(Lift, KeepsLoadFactorsWithinLimits) {
  const LiftGains gains;
  for (const bool over_bank : {false, true}) {
    LiftGains k = gains;
    k.over_bank = over_bank;
    for (double roll = -3; roll <= 3; roll += 0.5) {
      for (double vertical = -300; vertical <= 300; vertical += 50) {
        const double n = PointLift(k, Banked(roll), 500.0, vertical).load_factor;
        EXPECT_GE(n, k.min_load_factor);
        EXPECT_LE(n, k.max_load_factor);
      }
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
