// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/piston_engine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "envs/air/atmosphere.h"
#include "envs/aircraft/engine.h"
#include "envs/aircraft/units.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kRounding{1e-9, "float64 rounding, relative"};
constexpr Tolerance kBisection{1e-6, "bisection of the propeller's speed, relative"};

/// 120 kW at 2700 rpm, 1.9 m.
PistonEngine FixedPitch() {
  PistonEngine engine;
  engine.rated_power_W = 120e3;
  engine.rated_rpm = 2700;
  engine.diameter_m = 1.9;
  engine.advance_ratio = {0, 0.5, 1};
  engine.CT = {0.08, 0.08, 0};
  engine.CP = {0.06, 0.06, 0};
  return engine;
}

PistonEngine ConstantSpeed() {
  PistonEngine engine = FixedPitch();
  engine.propeller = PropellerModel::kConstantSpeed;
  engine.advance_ratio = {0, 0.4, 0.8, 1.2};
  engine.efficiency = {0, 0.6, 0.8, 0.7};
  return engine;
}

double SeaLevelDensity() {
  return AirAt(AtmosphereModel::kStandard1976, 0).density_slug_ft3 * kKgM3PerSlugFt3;
}

// Standing, torque Q = P / (2 pi n_rated) turns the propeller at n^2 = 2 pi Q / (CP rho D^5).
TEST(PistonEngine, StandingPropellerTakesTheEnginesTorque) {
  const double rho = SeaLevelDensity();
  const double n2 = 120e3 / 45 / (0.06 * rho * std::pow(1.9, 5));
  const double thrust = 0.08 * rho * n2 * std::pow(1.9, 4);
  EXPECT_NEAR(PistonThrust(FixedPitch(), 1, 0, 0) / thrust, 1, kBisection);
  EXPECT_NEAR(PistonThrust(FixedPitch(), 0.5, 0, 0) / thrust, 0.5, kBisection);
}

// With CT and CP falling alike, thrust times speed over power taken is J CT / CP.
TEST(PistonEngine, NoPropellerIsBetterThanItsTables) {
  const PistonEngine engine = FixedPitch();
  for (double speed = 5; speed <= 80; speed += 5) {
    const double thrust = PistonThrust(engine, 1, speed, 0);
    // Power at most: the rated torque at the speed J = 1, no thrust beyond it.
    const double fastest_power = 120e3 / 45 * (speed / 1.9);
    EXPECT_LT(thrust * speed, std::max(fastest_power, 1.4 * 120e3)) << speed;
    EXPECT_GT(thrust, 0) << speed;
  }
}

TEST(PistonEngine, ConstantSpeedGivesEfficiencyTimesPower) {
  const PistonEngine engine = ConstantSpeed();
  const double tip = 45 * 1.9;  // n D
  EXPECT_NEAR(PistonThrust(engine, 1, 0.8 * tip, 0) * 0.8 * tip / (0.8 * 120e3), 1, kRounding);
  EXPECT_NEAR(PistonThrust(engine, 0.3, 0.4 * tip, 0) * 0.4 * tip / (0.18 * 120e3), 1, kRounding);
  // From the first node down the thrust is that of its slope: finite at rest.
  EXPECT_NEAR(PistonThrust(engine, 1, 0, 0), PistonThrust(engine, 1, 0.4 * tip, 0),
              kRounding * 1e4);
}

// A propeller whose CT and CP make a straight polar gives the polar's thrust, at any speed.
TEST(PistonEngine, StraightPolarIsThatOfAFixedPitchPropeller) {
  constexpr Tolerance kBetweenNodes{0.02, "CT and CP are linear between 100 nodes, relative"};
  PistonEngine fixed = FixedPitch(), polar = FixedPitch();
  fixed.advance_ratio.clear();
  fixed.CT.clear();
  fixed.CP.clear();
  for (double J = 0; J <= 1; J += 0.01) {
    fixed.advance_ratio.push_back(J);
    fixed.CP.push_back(0.06 - 0.02 * J * J);
    fixed.CT.push_back(1.7 * fixed.CP.back() - 0.05 * J * J);
  }
  polar.propeller = PropellerModel::kPolar;
  polar.polar_slope = 1.7;
  polar.polar_intercept = -0.05;
  for (double speed = 0; speed <= 60; speed += 10) {
    EXPECT_NEAR(PistonThrust(fixed, 1, speed, 0) / PistonThrust(polar, 1, speed, 0), 1,
                kBetweenNodes)
        << speed;
  }
}

TEST(PistonEngine, PowerFallsWithDensityOrByTheFilesTable) {
  PistonEngine engine = FixedPitch();
  EXPECT_NEAR(PowerFraction(engine, 0), 1, kRounding);
  const double sigma = AirAt(AtmosphereModel::kStandard1976, 10000).density_slug_ft3 *
                       kKgM3PerSlugFt3 / SeaLevelDensity();
  EXPECT_NEAR(PowerFraction(engine, 10000), sigma - (1 - sigma) * 0.132, kRounding);
  EXPECT_EQ(PowerFraction(engine, 1e5), 0);  // none left, not less
  engine.altitude_m = {1000, 3000};
  engine.power_fraction = {1, 0.5};
  EXPECT_NEAR(PowerFraction(engine, 2000 * kFeetPerMetre), 0.75, kRounding);
  EXPECT_EQ(PowerFraction(engine, 0), 1);
}

TEST(PistonEngine, TablesHoldTheThrustAtTheirNodes) {
  const ThrottleLevels levels{0.1, 0.5, 1};
  const EngineTables tables = TabulatePiston(FixedPitch(), levels, {12000, 0.24});
  EXPECT_EQ(tables.altitude_ft.front(), -2000);
  EXPECT_EQ(tables.altitude_ft.back(), 12000);
  EXPECT_EQ(tables.mach.back(), 0.24);
  for (const double altitude_ft : tables.altitude_ft) {
    const double sound = AirAt(AtmosphereModel::kStandard1976, altitude_ft).sound_speed_ft_s;
    for (const double mach : tables.mach) {
      EXPECT_NEAR(Thrust(tables, 50, altitude_ft, mach) * kNewtonsPerLbf,
                  PistonThrust(FixedPitch(), 0.5, mach * sound * kMetresPerFoot, altitude_ft),
                  kRounding * 1e4);
    }
  }
}

}  // namespace
}  // namespace skein
