// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/propeller.h"

#include <gtest/gtest.h>

#include <cmath>

#include "envs/air/atmosphere.h"
#include "envs/aircraft/derivative_aircraft_file.h"
#include "envs/aircraft/engine.h"
#include "envs/aircraft/registry.h"
#include "envs/aircraft/units.h"
#include "tests/extremes.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kRounding{1e-9, "float64 rounding"};
constexpr Tolerance kThinAir{1e-6, "thrust of air of 1e-9 kg/m^3"};
constexpr Tolerance kBetweenNodesN{0.45, "cells of 4.8 m/s and 5000 ft, of 80 N"};
constexpr Tolerance kStraightPiecesN{1.6, "three straight pieces for a parabola"};

class AerosondePropeller : public ::testing::Test {
 protected:
  const DerivativeAircraft aircraft_ =
      ReadDerivativeAircraft("aerosonde", *AircraftFiles()[0].text);
  const ElectricPropulsion& propulsion_ = std::get<ElectricPropulsion>(aircraft_.propulsion);
  const Propeller& propeller_ = propulsion_.propeller;
  const Aircraft flown_ = LoadAircraft("aerosonde");
};

// Check values of Beard and McLain's public simulation files (chap4_check.py), at the book's air
// density.
TEST_F(AerosondePropeller, GivesThePublishedThrust) {
  constexpr double kBookDensity = 1.2682;
  EXPECT_NEAR(PropellerThrust(propeller_, 0.5, 25, kBookDensity), -12.43072534597213, kRounding);
  EXPECT_NEAR(PropellerThrust(propeller_, 1, 25, kBookDensity), 37.7794805541605, kRounding);
  EXPECT_NEAR(PropellerThrust(propeller_, 1, 27.39323489287441, kBookDensity), 31.31315544701058,
              kRounding);
}

// What the speed is found from: the propeller takes the torque that the motor gives. Without air
// there is none, and the motor turns as fast as its voltage less the no-load current's asks for.
TEST_F(AerosondePropeller, ThrustVanishesWithTheAir) {
  EXPECT_NEAR(PropellerThrust(propeller_, 1, 25, 1e-9), 0, kThinAir);
  EXPECT_GT(PropellerThrust(propeller_, 1, 0, 1.225), PropellerThrust(propeller_, 1, 10, 1.225));
}

TEST_F(AerosondePropeller, TablesHoldItsThrustAtEveryLevelOfPower) {
  const struct {
    double power, motor_throttle;
  } levels[] = {{0, propulsion_.levels.idle},
                {50, propulsion_.levels.military},
                {100, propulsion_.levels.maximum}};
  for (double altitude_ft = -2000; altitude_ft <= 13000; altitude_ft += 730) {
    const Air air = AirAt(AtmosphereModel::kStandard1976, altitude_ft);
    for (double speed = 0; speed <= 44; speed += 1.1) {
      const double mach = speed * kFeetPerMetre / air.sound_speed_ft_s;
      for (const auto& level : levels) {
        EXPECT_NEAR(Thrust(flown_.engine, level.power, altitude_ft, mach) * kNewtonsPerLbf,
                    PropellerThrust(propeller_, level.motor_throttle, speed,
                                    air.density_slug_ft3 * kKgM3PerSlugFt3),
                    kBetweenNodesN)
            << altitude_ft << " ft, " << speed << " m/s";
      }
    }
  }
}

// Between the levels thrust is linear in power, and power in the throttle on either side of a knee:
// three straight pieces for what is nearly a parabola.
TEST_F(AerosondePropeller, TheThrottleCommandsNearlyTheMotors) {
  const PropellerLevels& levels = propulsion_.levels;
  const Air air = AirAt(AtmosphereModel::kStandard1976, 0);
  double worst = 0;
  for (double speed = 12; speed <= 36; speed += 1.5) {
    const double mach = speed * kFeetPerMetre / air.sound_speed_ft_s;
    for (double throttle = 0; throttle <= 1; throttle += 0.01) {
      const double power = PowerCommand(flown_.throttle_gearing, throttle);
      const double flown = Thrust(flown_.engine, power, 0, mach) * kNewtonsPerLbf;
      const double motor_throttle = levels.idle + (levels.maximum - levels.idle) * throttle;
      const double exact = PropellerThrust(propeller_, motor_throttle, speed,
                                           air.density_slug_ft3 * kKgM3PerSlugFt3);
      worst = Larger(worst, std::abs(flown - exact));
    }
  }
  EXPECT_LT(worst, kStraightPiecesN + kBetweenNodesN);
  RecordProperty("worst_mN", static_cast<int>(1000 * worst));
}

TEST_F(AerosondePropeller, PowerFollowsWithOneLag) {
  for (const double power : {0.0, 30.0, 49.0, 50.0, 51.0, 100.0}) {
    for (const double command : {0.0, 40.0, 50.0, 60.0, 100.0}) {
      EXPECT_DOUBLE_EQ(PowerRate(flown_.power_lag, power, command), 5 * (command - power));
    }
  }
}

TEST_F(AerosondePropeller, ThrottleForPowerInvertsTheGearing) {
  for (double power = 0; power <= 100; power += 2.5) {
    const double throttle = ThrottleForPower(flown_.throttle_gearing, power);
    EXPECT_NEAR(PowerCommand(flown_.throttle_gearing, throttle), power, kRounding);
  }
}

}  // namespace
}  // namespace skein
