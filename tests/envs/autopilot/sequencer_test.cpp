// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "envs/autopilot/sequencer-inl.h"
#include "gtest/gtest.h"
#include "tests/tolerance.h"

namespace skein {
namespace HWY_NAMESPACE {
namespace {

constexpr double kDt = 0.1;

struct Nose {
  Nose() {
    flight.altitude = 20000;
    flight.speed = 1000;
    motion.cos_roll = 1;
  }
  SequencerDemand<double> Update(double pitch, double yaw, double speed) {
    const auto demand =
        Sequence(gains, kDt, flight, motion, {pitch, yaw, speed}, Now<bool>{begins, true}, memory);
    begins = false;
    return demand;
  }

  SequencerGains gains;
  FlightEstimate<double> flight = {};
  Kinematics<double> motion = {};
  SequencerMemory<double> memory = {};
  bool begins = true;
};

TEST(Sequencer, SendsTheNoseWhereTheSpeedComesFromFirst) {
  Nose slow, fast;
  // The target lies the other way.
  EXPECT_LT(slow.Update(0.4, 0, 200).pitch, 0);
  EXPECT_GT(fast.Update(-0.4, 0, -200).pitch, 0);
}

TEST(Sequencer, SendsTheNoseToItsTargetWhenSpeedAndYawAreThere) {
  Nose nose;
  EXPECT_DOUBLE_EQ(nose.Update(0.1, 0.01, -1).pitch, 0.1);
  EXPECT_DOUBLE_EQ(nose.Update(0.1, 0.01, -1).speed_error, -1);
}

TEST(Sequencer, WaitsForTheYawToComeToRest) {
  Nose nose;
  nose.Update(0.1, 0.2, 0);
  EXPECT_NE(nose.Update(0.1, 0.05, 0).pitch, 0.1);  // 86 deg/s
  EXPECT_EQ(nose.Update(0.1, 0.04, 0).pitch, 0.1);
}

/// Nose up will cost speed: too fast by as much is right, exactly right is too slow.
TEST(Sequencer, ForeseesWhatGravityTakes) {
  constexpr Tolerance kRounding{1e-12, "float64 rounding"};
  constexpr Tolerance kSpeedRounding{1e-9, "float64 rounding of ft/s"};
  Nose nose;
  const double pitch = 0.4;
  const double seconds = 0.5 * (pitch / nose.gains.pitch_rate + 1);
  const double loss = nose.gains.speed_lead * kGravityFtS2 * std::sin(pitch) * seconds;
  EXPECT_NEAR(nose.Update(pitch, 0, -loss).pitch, pitch, kRounding);
  Nose slower;
  EXPECT_NEAR(slower.Update(pitch, 0, 0).speed_error, loss, kSpeedRounding);
}

TEST(Sequencer, BeginsAgainWhenTheTargetIsNotReachedInTime) {
  constexpr Tolerance kSteps{2 * kDt, "whole steps, at either end"};
  Nose nose;
  nose.gains.speed_lead = 0;
  EXPECT_EQ(nose.Update(0.1, 0, 0).pitch, 0.1);
  int outer_steps = 0;
  while (nose.Update(0.1, 0, -100).pitch == 0.1) ++outer_steps;
  EXPECT_NEAR(outer_steps * kDt, nose.gains.patience_s, kSteps);
}

TEST(Sequencer, StaysAtTheTargetWhileItIsNearEnough) {
  Nose nose;
  nose.gains.speed_lead = 0;
  nose.Update(0.1, 0, 0);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(nose.Update(0.1, 0.05, -30).pitch, 0.1);
}

TEST(Sequencer, ClimbsNearTheGround) {
  Nose nose;
  nose.flight.altitude = 5000;
  EXPECT_GE(nose.Update(-0.4, 1, 300).pitch, nose.gains.low_altitude_pitch);
}

TEST(Sequencer, LeavesEverythingAtOnceWithoutIt) {
  Nose nose;
  nose.gains.enabled = false;
  const auto demand = nose.Update(-0.4, 2, -200);
  EXPECT_EQ(demand.pitch, -0.4);
  EXPECT_EQ(demand.speed_error, -200);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
