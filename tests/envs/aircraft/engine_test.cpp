// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/engine.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "envs/aircraft/f16.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kRounding{1e-9, "float64 rounding of 1e4 lbf"};
constexpr Tolerance kDigits{1e-4, "four decimals published"};
constexpr Tolerance kDetent{2e-3, "the gearing's step of 0.0012 at the detent"};
constexpr Tolerance kThrustRounding{1e-6, "float64 rounding of growing thrust"};
constexpr Tolerance kInverseRounding{1e-8, "float64 rounding there and back"};
constexpr Tolerance kSettled{1e-6, "what a lag leaves after 60 s"};

class Engine : public ::testing::Test {
 protected:
  Aircraft aircraft_ = F16();
  EngineTables tables_ = aircraft_.engine;
  ThrottleGearing gearing_ = aircraft_.throttle_gearing;
  PowerLag lag_ = aircraft_.power_lag;
};

TEST_F(Engine, ThrottleCommandsMilitaryAtItsDetentAndMaximumAtTheStop) {
  // The published gearing steps by 0.0012 at the detent.
  EXPECT_NEAR(PowerCommand(gearing_, 0), 0, kRounding);
  EXPECT_NEAR(PowerCommand(gearing_, 0.77), 50.0038, kDigits);
  EXPECT_NEAR(PowerCommand(gearing_, 0.7700001), 50.0026, kDigits);
  EXPECT_NEAR(PowerCommand(gearing_, 1), 100, kRounding);
  EXPECT_EQ(PowerCommand(gearing_, -1), 0);
  EXPECT_EQ(PowerCommand(gearing_, 2), PowerCommand(gearing_, 1));
  for (double power = 0; power <= 100; power += 2.5) {
    EXPECT_NEAR(PowerCommand(gearing_, ThrottleForPower(gearing_, power)), power, kDetent) << power;
  }
}

TEST_F(Engine, ThrustIsThatOfTheTablesAtTheirNodes) {
  EXPECT_NEAR(Thrust(tables_, 0, 0, 0), 1060, kRounding);
  EXPECT_NEAR(Thrust(tables_, 50, 10000, 0.6), 9839, kRounding);
  EXPECT_NEAR(Thrust(tables_, 100, 40000, 1), 8642, kRounding);
  EXPECT_NEAR(Thrust(tables_, 25, 0, 0), (1060 + 12680) / 2, kRounding);
  EXPECT_NEAR(Thrust(tables_, 75, 0, 0), (12680 + 20000) / 2, kRounding);
}

TEST_F(Engine, IdleThrustIsNegativeWhereRamDragWins) {
  EXPECT_NEAR(Thrust(tables_, 0, 0, 1), -3600, kRounding);
}

TEST_F(Engine, ThrustIsClampedOutsideTheTables) {
  EXPECT_EQ(Thrust(tables_, 100, 20000, 1.7), Thrust(tables_, 100, 20000, 1));
  EXPECT_EQ(Thrust(tables_, 100, 70000, 0.5), Thrust(tables_, 100, 50000, 0.5));
  EXPECT_EQ(Thrust(tables_, 100, -500, 0.5), Thrust(tables_, 100, 0, 0.5));
}

TEST_F(Engine, ThrustGrowsAboveMachOneIfAskedTo) {
  const double held = Thrust(tables_, 80, 20000, 1);
  tables_.grows = true;
  EXPECT_EQ(Thrust(tables_, 80, 20000, 0.7), Thrust(F16().engine, 80, 20000, 0.7));
  EXPECT_NEAR(Thrust(tables_, 80, 20000, 1), held, kRounding);
  EXPECT_NEAR(Thrust(tables_, 80, 20000, 1.3), held * (1.069 + 1.154) / 2, kThrustRounding);
  EXPECT_NEAR(Thrust(tables_, 80, 20000, 3), held * 1.49, kThrustRounding);
  const double power = PowerForThrust(tables_, 15000, 20000, 1.5);
  EXPECT_NEAR(Thrust(tables_, power, 20000, 1.5), 15000, kThrustRounding);
}

TEST_F(Engine, PowerForThrustInvertsThrust) {
  for (double altitude = 0; altitude <= 50000; altitude += 5000) {
    for (double mach = 0; mach <= 1.2; mach += 0.13) {
      double least = 1e6;
      for (double power = 0; power <= 100; power += 12.5) {
        const double thrust = Thrust(tables_, power, altitude, mach);
        const double found = PowerForThrust(tables_, thrust, altitude, mach);
        EXPECT_NEAR(Thrust(tables_, found, altitude, mach), thrust, kInverseRounding);
        least = std::min(least, thrust);
      }
      EXPECT_EQ(PowerForThrust(tables_, 1e6, altitude, mach), 100);
      const double lowest = PowerForThrust(tables_, -1e6, altitude, mach);
      EXPECT_NEAR(Thrust(tables_, lowest, altitude, mach), least, kInverseRounding);
    }
  }
}

// Full throttle from idle needs 5.1 s to 99 % power, from 20 % power 2.3 s.
TEST_F(Engine, SpoolsUpInTheKnownTimes) {
  constexpr double kDt = 1e-3;
  constexpr Tolerance kPublishedDigits{0.06, "two digits published"};
  const auto time_to_99 = [&](double power) {
    double time = 0;
    for (; power < 99; time += kDt) power += kDt * PowerRate(lag_, power, 100);
    return time;
  };
  EXPECT_NEAR(time_to_99(0), 5.1, kPublishedDigits);
  EXPECT_NEAR(time_to_99(20), 2.3, kPublishedDigits);
}

TEST_F(Engine, PowerSettlesAtItsCommandFromEitherSide) {
  for (double command : {0.0, 30.0, 49.0, 60.0, 100.0}) {
    for (double start : {0.0, 45.0, 55.0, 100.0}) {
      double power = start;
      for (int i = 0; i < 3000; ++i) power += 0.02 * PowerRate(lag_, power, command);
      EXPECT_NEAR(power, command, kSettled) << "from " << start;
    }
  }
}

}  // namespace
}  // namespace skein
