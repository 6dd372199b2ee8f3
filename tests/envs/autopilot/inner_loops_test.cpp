// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "envs/autopilot/inner_loops-inl.h"
#include "gtest/gtest.h"
#include "tests/tolerance.h"

namespace skein {
namespace HWY_NAMESPACE {
namespace {

constexpr double kDt = 0.02;

struct Loops {
  Loops() {
    flight.speed = 1000;
    motion.cos_roll = motion.cos_pitch = 1;
  }
  double Roll(double demand) { return RollStick(gains, lift, kDt, flight, demand, memory); }
  double Pitch(double load_factor) {
    return PitchStick(gains, kDt, flight, motion, load_factor, memory);
  }

  InnerLoopGains gains;
  LiftGains lift;
  FlightEstimate<double> flight = {};
  Kinematics<double> motion = {};
  InnerLoopMemory<double> memory = {};
};

TEST(InnerLoops, CentreTheSticksWhereNothingIsWanted) {
  Loops loops;
  EXPECT_EQ(loops.Roll(0), 0);
  EXPECT_EQ(loops.Pitch(1), 0);
}

TEST(InnerLoops, AskForWhatFullStickGives) {
  Loops loops;
  loops.gains.pitch_proportional = loops.gains.pitch_integral = 0;
  EXPECT_DOUBLE_EQ(loops.Pitch(1 + 0.5 * loops.gains.full_aft_load_factor), 0.5);
  EXPECT_DOUBLE_EQ(loops.Pitch(1 - 0.5 * loops.gains.full_forward_load_factor), -0.5);
}

/// A pitch rate that already bends the path as asked leaves only the load factor to hold.
TEST(InnerLoops, PitchRateOfThePathIsNoError) {
  constexpr Tolerance kRounding{1e-15, "float64 rounding"};
  Loops loops;
  loops.flight.q = kGravityFtS2 / 1000 * (3 - 1);
  EXPECT_DOUBLE_EQ(loops.Pitch(3), 2 / loops.gains.full_aft_load_factor);
  EXPECT_NEAR(loops.memory.load_factor, 0, kRounding);
}

TEST(InnerLoops, RollTheShorterWayRoundOnlyToInvertedFlight) {
  Loops loops;
  loops.flight.roll = -2.5;
  EXPECT_LT(loops.Roll(2.5), 0);  // 1.28 rad through inverted, not 5 rad
  EXPECT_GT(loops.Roll(0.0), 0);
  loops.flight.roll = -3;
  EXPECT_GT(loops.Roll(0.5 * loops.lift.max_straight_bank), 0);  // upright, be it farther
}

TEST(InnerLoops, RollRateDemandIsLimited) {
  Loops loops;
  const double stick = loops.Roll(M_PI / 2);
  loops.memory = {};
  EXPECT_EQ(loops.Roll(1.2), stick);
}

TEST(InnerLoops, IntegrateARemainingError) {
  Loops loops;
  double stick = loops.Roll(0.1);
  for (int i = 0; i < 10; ++i) {
    const double next = loops.Roll(0.1);
    EXPECT_GT(next, stick);
    stick = next;
  }
}

TEST(InnerLoops, IntegratorsStandStillAtFullStick) {
  Loops loops;
  loops.flight.p = -10;  // rolling away faster than full stick rolls back
  for (int i = 0; i < 1000; ++i) loops.Roll(1.0);
  EXPECT_EQ(loops.Roll(1.0), 1);
  EXPECT_EQ(loops.memory.roll, 0);
  loops.flight.q = -1;
  for (int i = 0; i < 1000; ++i) loops.Pitch(6.0);
  EXPECT_EQ(loops.Pitch(6.0), 1);
  EXPECT_EQ(loops.memory.load_factor, 0);
}

TEST(InnerLoops, IntegratorsAreBounded) {
  Loops loops;
  for (int i = 0; i < 100000; ++i) {
    loops.Roll(0.01);
    loops.Pitch(1.1);
  }
  EXPECT_DOUBLE_EQ(loops.memory.roll, loops.gains.roll_integrator_limit);
  EXPECT_DOUBLE_EQ(loops.memory.load_factor, loops.gains.pitch_integrator_limit);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
