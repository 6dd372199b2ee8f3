// SPDX-License-Identifier: Apache-2.0
#include "train/measures/flight_measurer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "envs/state/attitude.h"
#include "envs/tasks/termination.h"
#include "tests/envs/test_tile.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kFloat{1e-5, "float32 rounding of states and of what is reported, relative"};
constexpr double kInterval = 0.02;

/// One aircraft whose control steps are written by hand.
class HandFlight {
 public:
  explicit HandFlight(const EnvConfig& env, int columns = kNumColumns)
      : tile(1, columns), measurer_(env) {
    measurer_.Begin(kAircraft, 1);
    SetAttitude(0);
    tile.Fill(kU, 1000);
  }

  void SetAttitude(double roll_rad) {
    const Eigen::Vector4d q = QuaternionFromEuler({roll_rad, 0.1, 0.5});
    for (int k = 0; k < 4; ++k) tile.Fill(kQ0 + k, static_cast<float>(q[k]));
  }

  /// One control step.
  void Fly(Termination termination = Termination::kNone) {
    ++step_;
    const auto kind = static_cast<std::int32_t>(termination);
    ControlStep seen;
    seen.first_aircraft = kAircraft;
    seen.state = tile.tile();
    seen.action = action;
    seen.termination = &kind;
    seen.errors = errors;
    seen.error_stride = 1;
    if (keeps_progress) {
      seen.progress = {&steps_within, &reached_step, &target_step, &targets_reached,
                       &targets_missed};
    }
    measurer_.See(seen);
  }

  /// Within tolerances, or not.
  void Fly(bool is_within, Termination termination = Termination::kNone) {
    steps_within = is_within ? steps_within + 1 : 0;
    Fly(termination);
  }

  int step() const { return step_; }
  FlightMeasures Report() { return measurer_.Report(0); }

  TestTile tile;
  float action[kActionSize] = {0, 0, 0, 0};
  float errors[kNumTaskErrors] = {0, 0, 0};
  bool keeps_progress = true;
  std::int32_t steps_within = 0, reached_step = 0, target_step = 0;
  std::int32_t targets_reached = 0, targets_missed = 0;

 private:
  static constexpr int kAircraft = 640;  // of a tile that does not begin at 0
  FlightMeasurer measurer_;
  int step_ = 0;
};

EnvConfig Holding(double hold_s) {
  EnvConfig env;
  env.hold_s = hold_s;
  return env;
}

/// Until its target is reached in the 100th step it rolls, and its sticks chatter.
void Reach(HandFlight* flight) {
  for (int i = 1; i < 100; ++i) {
    flight->SetAttitude(0.3 * i);
    flight->tile.Fill(kP, 15);
    flight->tile.Fill(kNz, static_cast<float>(i % 7));
    flight->errors[0] = 3;
    for (float& action : flight->action) action = i % 2 == 0 ? 2.0f : -2.0f;
    flight->Fly(false);
  }
  flight->reached_step = 100;
  flight->Fly(true);
}

TEST(FlightMeasurerTest, AHoldBeginsAfterTheStepThatReached) {
  HandFlight flight(Holding(2));
  Reach(&flight);
  for (int i = 0; i < 100; ++i) {
    const bool is_last = i == 99;
    flight.SetAttitude(-0.2);
    flight.tile.Fill(kP, 0.1f);
    flight.tile.Fill(kNz, i % 2 == 0 ? 0.9f : 1.1f);
    flight.tile.Fill(kV, 20);
    flight.errors[0] = 0.05f;
    flight.errors[1] = i % 2 == 0 ? 0.01f : -0.01f;
    for (float& action : flight.action) action = 0.25f;
    flight.Fly(i < 80, is_last ? Termination::kTargetReached : Termination::kNone);
  }
  const FlightMeasures measures = flight.Report();
  EXPECT_EQ(measures.reached_step, 100);
  EXPECT_FLOAT_EQ(measures.hold.within, 0.8f);
  EXPECT_NEAR(measures.hold.rms_errors[0], 0.05, kFloat);
  EXPECT_NEAR(measures.hold.rms_errors[1], 0.01, kFloat);
  EXPECT_NEAR(measures.hold.rms_p, 0.1 * 180 / M_PI, 10 * kFloat);
  EXPECT_NEAR(measures.hold.load_factor_deviation, 0.1, kFloat);
  EXPECT_NEAR(measures.hold.mean_abs_bank, 0.2 * 180 / M_PI, 10 * kFloat);
  EXPECT_NEAR(measures.hold.net_rolls_per_min, 0, kFloat);
  EXPECT_NEAR(measures.hold.rms_sideslip, std::atan(0.02) * 180 / M_PI, 10 * kFloat);
  for (int k = 0; k < kActionSize; ++k) {
    EXPECT_EQ(measures.hold_actions[k].variation_per_s, 0) << "the chatter was before";
    // 99 changes of 2 between the clipped ends, and one from the end to 0.25.
    EXPECT_NEAR(measures.actions[k].variation_per_s, (98 * 2 + 1.25) / (199 * kInterval),
                100 * kFloat);
    EXPECT_FLOAT_EQ(measures.actions[k].saturated, 0.5f);
  }
}

TEST(FlightMeasurerTest, ALostFlightHeldItsTargetUntilThen) {
  HandFlight flight(Holding(2));
  Reach(&flight);
  for (int i = 0; i < 24; ++i) flight.Fly(true);
  flight.Fly(true, Termination::kOverload);
  // The next episode, to the end of the policy step, is another's.
  for (int i = 0; i < 4; ++i) flight.Fly(true, Termination::kOverload);
  EXPECT_FLOAT_EQ(flight.Report().hold.within, 0.25f);
  EXPECT_EQ(flight.Report().reached_step, 100);
}

TEST(FlightMeasurerTest, WhatFailsInTheStepThatReachesHasNotReached) {
  HandFlight flight(Holding(2));
  flight.Fly(false);
  flight.reached_step = 2;
  flight.Fly(true, Termination::kLowAltitude);
  const FlightMeasures measures = flight.Report();
  EXPECT_EQ(measures.reached_step, 0);
  EXPECT_TRUE(std::isnan(measures.hold.within));
}

TEST(FlightMeasurerTest, WithoutProgressTheTargetIsReachedAtTheEnd) {
  HandFlight flight{EnvConfig()};
  flight.keeps_progress = false;
  for (int i = 0; i < 30; ++i) flight.Fly();
  flight.Fly(Termination::kTargetReached);
  const FlightMeasures measures = flight.Report();
  EXPECT_EQ(measures.reached_step, 31);
  EXPECT_TRUE(std::isnan(measures.hold.within));
  EXPECT_TRUE(std::isnan(measures.hold_actions[0].variation_per_s));
}

TEST(FlightMeasurerTest, AMissionIsMeasuredWhileItIsWithinTolerances) {
  EnvConfig env;
  env.mission.length_s = 8;
  HandFlight flight(env);
  // Four targets, each approached in a steep bank for a second, then held for a second, rolling by
  // a hundredth of a turn; the step that completes it shows the next one's progress.
  for (int target = 0; target < 4; ++target) {
    flight.tile.Fill(kQ, 1);
    flight.SetAttitude(1.4 * (target + 1));
    for (int i = 0; i < 50; ++i) flight.Fly(false);
    flight.tile.Fill(kQ, 0.02f);
    for (int i = 0; i < 50; ++i) {
      flight.SetAttitude(2 * M_PI * 0.01 * i / 49);
      const bool completes = i == 49;
      if (completes) ++flight.targets_reached;
      const bool ends = completes && target == 3;
      flight.Fly(!completes, ends ? Termination::kTimeLimit : Termination::kNone);
    }
  }
  const FlightMeasures measures = flight.Report();
  EXPECT_EQ(measures.targets_reached, 4);
  EXPECT_EQ(measures.reached_step, 0);
  EXPECT_FLOAT_EQ(measures.hold.within, 0.5f);
  EXPECT_NEAR(measures.hold.rms_q, 0.02 * 180 / M_PI, 10 * kFloat);
  const double rolls_per_min = 0.01 / (49 * kInterval / 60);
  EXPECT_NEAR(measures.hold.net_rolls_per_min, rolls_per_min, rolls_per_min * 10 * kFloat);
}

TEST(FlightMeasurerTest, ARollFromOneTargetToTheNextIsNoneOfHolding) {
  EnvConfig env;
  env.mission.length_s = 2;
  HandFlight flight(env);
  for (int i = 0; i < 100; ++i) {
    const bool completes = i == 49;
    flight.SetAttitude(i < 50 ? 0 : 0.5);
    flight.targets_reached += completes;
    flight.Fly(!completes);  // at the next one in the step after
  }
  EXPECT_FLOAT_EQ(flight.Report().hold.within, 1);
  EXPECT_NEAR(flight.Report().hold.net_rolls_per_min, 0, kFloat);
}

TEST(FlightMeasurerTest, SideslipIsRelativeToTheAir) {
  HandFlight flight(Holding(1), kNumWindyColumns);
  flight.tile.Fill(kV, 50);  // over the ground
  flight.tile.Fill(kAirU, 600);
  flight.tile.Fill(kAirV, -10);
  flight.tile.Fill(kAirW, 800);
  flight.reached_step = 1;
  flight.Fly(true);
  for (int i = 0; i < 50; ++i) flight.Fly(true);
  EXPECT_NEAR(flight.Report().hold.rms_sideslip, std::atan(0.01) * 180 / M_PI, 10 * kFloat);
}

TEST(FlightMeasurerTest, AFlightThatIsNotFiniteHasCountsAlone) {
  HandFlight flight(Holding(2));
  Reach(&flight);
  for (int i = 0; i < 60; ++i) flight.Fly(true);
  flight.tile.Fill(kP, std::nanf(""));
  flight.Fly(true, Termination::kNonFinite);
  const FlightMeasures measures = flight.Report();
  EXPECT_EQ(measures.reached_step, 100);
  EXPECT_EQ(measures.hold.within, 0);
  EXPECT_TRUE(std::isnan(measures.hold.rms_p));
  EXPECT_TRUE(std::isnan(measures.actions[1].saturated));
}

}  // namespace
}  // namespace skein
