// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "envs/autopilot/tecs-inl.h"
#include "gtest/gtest.h"
#include "tests/tolerance.h"

namespace skein {
namespace HWY_NAMESPACE {
namespace {

constexpr double kSpeed = 1000;
constexpr double kDt = 0.1;
constexpr double kLevelThrottle = 0.3f;
constexpr Now<bool> kFirst{true, true}, kLater{false, true}, kBetween{false, false};

/// Level, straight, unaccelerated flight.
struct LevelFlight {
  LevelFlight() {
    flight.speed = kSpeed;
    motion.cos_roll = 1;
  }
  double Throttle(const EnergyDemand<double>& demand, const Now<bool>& now = kFirst) {
    UpdateThrottle(gains, kDt, flight, motion, demand, now, memory);
    return memory.throttle;
  }

  TecsGains gains;
  FlightEstimate<double> flight = {};
  Kinematics<double> motion = {};
  TecsMemory<double> memory = {};
};

TEST(Tecs, HoldsLevelThrottleWithoutErrors) {
  LevelFlight level;
  EXPECT_DOUBLE_EQ(level.Throttle({0, 0, 0}), kLevelThrottle);
}

/// Too low and too fast by the same energy: pitch exchanges them, the throttle stays.
constexpr Tolerance kRounding{1e-12, "float64 rounding"};

TEST(Tecs, LeavesTheThrottleWhereTotalEnergyIsRight) {
  LevelFlight level;
  const double speed_error = -20;
  const double height_error = -kSpeed * speed_error / kGravityFtS2;
  // The climb that gives away speed at the rate at which the demand takes it.
  const double climb = -kSpeed * speed_error / level.gains.time_constant_s / kGravityFtS2;
  EXPECT_NEAR(level.Throttle({speed_error, height_error, climb}), kLevelThrottle, kRounding);
}

TEST(Tecs, AddsThrottleForEnergyThatLacks) {
  LevelFlight low, slow, fast;
  EXPECT_GT(low.Throttle({0, 100, 0}), kLevelThrottle);
  EXPECT_GT(slow.Throttle({10, 0, 0}), kLevelThrottle);
  EXPECT_LT(fast.Throttle({-10, 0, 0}), kLevelThrottle);
}

TEST(Tecs, AddsThrottleInABank) {
  LevelFlight level, banked;
  banked.motion.cos_roll = std::cos(1.0);
  EXPECT_GT(banked.Throttle({0, 0, 0}), level.Throttle({0, 0, 0}));
}

/// The throttle that a demanded energy rate needs, one interval of it against idle.
TEST(Tecs, FullRangeOfTheThrottleSpansTheEnergyRates) {
  constexpr Tolerance kDigits{0.005, "two digits of the gain"};
  TecsGains gains;
  EXPECT_NEAR(gains.level_throttle.at[0],
              -gains.min_energy_rate / (gains.max_energy_rate - gains.min_energy_rate), kDigits);
}

TEST(Tecs, IntegratesWhatRemains) {
  LevelFlight level;
  double throttle = level.Throttle({2, 0, 0});
  for (int i = 0; i < 10; ++i) {
    const double next = level.Throttle({2, 0, 0}, kLater);
    EXPECT_GT(next, throttle);
    throttle = next;
  }
}

TEST(Tecs, IntegratorStopsWhileTheThrottleIsAtEitherLimit) {
  for (const double speed_error : {300, -300}) {
    LevelFlight level;
    level.Throttle({speed_error, 0, 0});
    for (int i = 0; i < 1000; ++i) level.Throttle({speed_error, 0, 0}, kLater);
    EXPECT_EQ(level.memory.throttle, speed_error > 0 ? 1 : 0);
    EXPECT_EQ(level.memory.integrator, 0);
    // Nothing is left of it when the error has gone.
    EXPECT_DOUBLE_EQ(level.Throttle({0, 0, 0}, kLater), kLevelThrottle);
  }
}

TEST(Tecs, IntegratorStaysWithinItsLimit) {
  LevelFlight level;
  level.Throttle({5, 0, 0});
  for (int i = 0; i < 100000; ++i) level.Throttle({5, 0, 0}, kLater);
  EXPECT_LE(level.memory.integrator, level.gains.integrator_limit);
}

TEST(Tecs, ChangesNothingBetweenOuterSteps) {
  LevelFlight level;
  const double throttle = level.Throttle({2, 0, 0});
  const double integrator = level.memory.integrator;
  EXPECT_EQ(level.Throttle({50, 0, 0}, kBetween), throttle);
  EXPECT_EQ(level.memory.integrator, integrator);
}

TEST(ClimbRate, IsContinuousAndOdd) {
  constexpr Tolerance kSlope{1e-5, "the slope over 1e-9 of the knee to either side"};
  const TecsGains gains;
  const double knee = gains.height_deceleration / (gains.height_bandwidth * gains.height_bandwidth);
  EXPECT_NEAR(ClimbRateFor(gains, knee * (1 - 1e-9), kSpeed),
              ClimbRateFor(gains, knee * (1 + 1e-9), kSpeed), kSlope);
  EXPECT_EQ(ClimbRateFor(gains, -500.0, kSpeed), -ClimbRateFor(gains, 500.0, kSpeed));
  EXPECT_NEAR(ClimbRateFor(gains, 10.0, kSpeed), 10 * gains.height_bandwidth, kRounding);
}

/// Following it from far away never takes more than the deceleration.
TEST(ClimbRate, CanBeFollowedWithTheDeceleration) {
  TecsGains gains;
  gains.max_climb_rate = 1e9;
  gains.max_climb_angle = M_PI / 2;
  double error = 3000;
  constexpr double kStep = 1e-3;
  constexpr Tolerance kSteps{1e-3, "steps of 1 ms, relative"};
  double rate = ClimbRateFor(gains, error, 1e6);
  for (int i = 0; i < 40000; ++i) {
    error -= kStep * rate;
    const double next = ClimbRateFor(gains, error, 1e6);
    ASSERT_LE((rate - next) / kStep, gains.height_deceleration * (1 + kSteps));
    rate = next;
  }
  EXPECT_LT(error, 1);
}

TEST(ClimbRate, KeepsWithinTheClimbAngle) {
  constexpr Tolerance kSpeedRounding{1e-9, "float64 rounding of ft/s"};
  const TecsGains gains;
  EXPECT_NEAR(ClimbRateFor(gains, 1e5, 400.0), 400 * std::sin(gains.max_climb_angle),
              kSpeedRounding);
  EXPECT_EQ(ClimbRateFor(gains, -1e5, 2000.0), -gains.max_climb_rate);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
