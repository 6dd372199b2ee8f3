// SPDX-License-Identifier: Apache-2.0
#include "envs/mission_rules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "envs/vec_env.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kFloat32{1e-6, "float32 rounding"};
constexpr Tolerance kRounding{1e-9, "float64 rounding of altitudes, ft"};
constexpr Tolerance kSteadyPitch{0.05, "pitch of steady flight, about which targets are drawn"};

constexpr double kHighestFt = 19000, kLowestFt = 8000;
/// What missions lead back by where they have lost 5000 ft and more, rad.
constexpr double kMostLedBack = 0.25, kLedBackBelowFt = kHighestFt - 5000;
constexpr double kPitchChange = 0.1;

TEST(MissionRules, WhatJoinsAMissionIsAskedForWhatItsNextTargetWouldBe) {
  const EnvConfig config;
  simd::RandomStream random({7, 0, 0, 0, simd::RandomPurpose::kInitialState});
  for (int draw = 0; draw < 100; ++draw) {
    FlightStart joined;
    joined.altitude_ft = kLowestFt;
    joined.true_airspeed_ft_s = 700;
    JoinMission(config, false, &random, &joined);
    EXPECT_GE(joined.altitude_ft, config.initial.altitude_ft.min);
    EXPECT_LE(joined.altitude_ft, config.initial.altitude_ft.max);
    EXPECT_GE(joined.true_airspeed_ft_s, config.initial.true_airspeed_fps.min);
    EXPECT_LE(joined.true_airspeed_ft_s, config.initial.true_airspeed_fps.max);
    EXPECT_EQ(joined.pitch_rad, kMostLedBack);

    FlightStart next = joined;
    LimitDescent(config, kLowestFt, &next);
    EXPECT_EQ(joined.lowest_pitch_rad, next.lowest_pitch_rad);
    EXPECT_EQ(joined.lowest_altitude_ft, next.lowest_altitude_ft);
  }
}

TEST(MissionRules, NoDiveForALowestPitchEndsBelowTheLowestAltitude) {
  constexpr double kDiveSpeed = 1.3;  // of the start's airspeed
  constexpr double kClearance = 0.1;  // of the start's height above the floor
  const EnvConfig config;
  const double floor_ft = config.termination.min_altitude_ft;
  FlightStart start;
  start.altitude_ft = 15000;
  start.true_airspeed_ft_s = 700;
  const double flown_ft =
      kDiveSpeed * start.true_airspeed_ft_s * config.time_limit_steps * config.control_interval_s;
  for (const double altitude_ft : {6000.0, 15000.0, 24000.0}) {
    LimitDescent(config, altitude_ft, &start);
    EXPECT_NEAR(start.lowest_altitude_ft, floor_ft + kClearance * (start.altitude_ft - floor_ft),
                kRounding);
    EXPECT_NEAR(altitude_ft + flown_ft * std::sin(start.lowest_pitch_rad), start.lowest_altitude_ft,
                kRounding);
  }
}

EnvConfig LowTraining(const std::string& task, double share) {
  EnvConfig config;
  config.task = task;
  config.initial.altitude_ft = {kHighestFt, kHighestFt};
  config.initial.training_altitude_min_ft = kLowestFt;
  config.control.pitch_change_rad = kPitchChange;
  config.tracking.distance_ft = {500, 1000};
  config.mission.training_target_share = share;
  return config;
}

/// Of flights that begin where missions lead back the most, the share that is asked for a pitch
/// about that; the others are asked for one about level.
double ShareLedBack(double share) {
  const VecEnv env(LowTraining("control", share), 1000, 1);
  int low = 0, led_back = 0;
  for (int i = 0; i < env.num_aircraft(); ++i) {
    if (-env.StateOf(i, kDown) > kLedBackBelowFt) continue;
    ++low;
    const double pitch = env.TargetOf(i)[0];
    const bool leads_back = std::abs(pitch - kMostLedBack) <= kPitchChange + kFloat32;
    led_back += leads_back;
    EXPECT_TRUE(leads_back || std::abs(pitch) <= kPitchChange + kSteadyPitch) << pitch;
  }
  return static_cast<double>(led_back) / low;
}

TEST(MissionRules, AShareOfTrainingIsAskedForTargetsOfMissions) {
  constexpr int kFewestLow = 400;  // 1000 flights, a little more than half of which begin low
  EXPECT_EQ(ShareLedBack(0), 0);
  EXPECT_EQ(ShareLedBack(1), 1);
  EXPECT_NEAR(ShareLedBack(0.5), 0.5, kStandardErrors * 0.5 / std::sqrt(kFewestLow));
  EXPECT_EQ(EvaluationConfig(LowTraining("control", 1)).mission.training_target_share, 0);
}

TEST(MissionRules, AltitudesAreThoseOfTheMissionAndPointsThoseOfTheAircraft) {
  const EnvConfig heading = LowTraining("heading", 1), tracking = LowTraining("tracking", 1);
  const VecEnv levels(heading, 50, 1), points(tracking, 50, 1);
  for (int i = 0; i < levels.num_aircraft(); ++i) {
    EXPECT_LE(std::abs(levels.TargetOf(i)[0] - kHighestFt), heading.heading.altitude_change_ft);
    EXPECT_LE(std::abs(points.TargetOf(i)[2] + points.StateOf(i, kDown)),
              tracking.tracking.distance_ft.max);
  }
}

}  // namespace
}  // namespace skein
