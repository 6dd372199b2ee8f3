// SPDX-License-Identifier: Apache-2.0
// Environments whose targets are held, followed by others, and whose handling costs reward.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "envs/aircraft/aircraft.h"
#include "envs/state/attitude.h"
#include "envs/task_registry.h"
#include "envs/vec_env.h"
#include "tests/envs/step_buffers.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kFloat32{1e-3, "float32 rounding of 700, or of 200 in each of 50 sums"};
constexpr Tolerance kBearing{1e-4, "float32 rounding of positions, in rad"};

/// What the policy steps of all aircraft gave, aircraft by aircraft, and their targets after each.
struct Log {
  std::vector<float> values;
  std::vector<int> terminations, steps;

  bool operator==(const Log& other) const {
    return values == other.values && terminations == other.terminations && steps == other.steps;
  }
};

/// Flies hands off, but for a stick that is moved now and then.
Log Fly(VecEnv* env, int policy_steps, ControlStepObserver* observer = nullptr) {
  Log log;
  for (int step = 0; step < policy_steps; ++step) {
    for (int tile = 0; tile < env->num_tiles(); ++tile) {
      StepBuffers buffers(env->tile_count(tile));
      for (std::size_t i = 0; i < buffers.reward.size(); ++i) {
        buffers.action[4 * i] = 0.5f;
        buffers.action[4 * i + 2] = step % 4 == 0 ? 0.1f : 0.0f;
      }
      StepOutput output = buffers.output();
      output.observer = observer;
      env->Step(tile, buffers.action.data(), output);
      for (std::size_t i = 0; i < buffers.reward.size(); ++i) {
        log.values.push_back(buffers.reward[i]);
        log.terminations.push_back(buffers.termination[i]);
        if (buffers.termination[i] != 0) log.steps.push_back(buffers.episode_steps[i]);
        const std::vector<float> target =
            env->TargetOf(env->tile_begin(tile) + static_cast<int>(i));
        log.values.insert(log.values.end(), target.begin(), target.end());
      }
    }
  }
  return log;
}

/// Targets that every flight is at for a while.
EnvConfig NearTargets(const std::string& task) {
  EnvConfig config;
  config.task = task;
  config.action_repeat = 3;
  config.heading.earliest_success_step = 0;
  config.heading.altitude_change_ft = config.heading.speed_change_fps = 10;
  config.heading.yaw_change_rad = 0.01;
  config.control.pitch_change_rad = config.control.yaw_change_rad = 0.01;
  config.control.speed_change_fps = 10;
  config.tracking.distance_ft = {200, 500};
  config.tracking.position_tolerance_ft = 1000;
  return config;
}

EnvConfig Mission(const std::string& task) {
  EnvConfig config = NearTargets(task);
  config.mission.length_s = 6;
  config.mission.dwell_s = 1;
  config.time_limit_steps = 100;
  config.reward.near_roll_rate = config.reward.action_change = 0.1;
  return config;
}

TEST(VecEnvProgress, MissionsDependOnNeitherTilesNorTheOtherAircraftAndGoOnFromSnapshots) {
  for (const std::string& task : TaskNames()) {
    VecEnv small(Mission(task), 70, 1, 32), large(Mission(task), 70, 1, 4096);
    // Tile by tile is another order of the log: compare the states instead.
    Fly(&small, 60);
    const Log whole = Fly(&large, 60);
    const std::vector<std::uint32_t> snapshot = small.Snapshot();
    EXPECT_EQ(snapshot, large.Snapshot()) << task;
    VecEnv other(Mission(task), 70, 1, 4096);
    EXPECT_EQ(Fly(&other, 60), whole) << task;
    other.Restore(snapshot);
    EXPECT_EQ(Fly(&other, 60), Fly(&large, 60)) << task;
  }
}

TEST(VecEnvProgress, AMissionGivesTargetAfterTargetAndEndsWithItsLength) {
  for (const std::string& task : TaskNames()) {
    VecEnv env(Mission(task), 8, 1);
    const std::vector<float> first = env.TargetOf(0);
    const Log log = Fly(&env, 50);
    EXPECT_TRUE(log.steps.empty()) << task;
    EXPECT_NE(env.TargetOf(0), first) << task;
    // Six seconds are three hundred control steps.
    const Log rest = Fly(&env, 50);
    EXPECT_EQ(rest.steps, std::vector<int>(8, 300)) << task;
    for (const int termination : rest.terminations) {
      EXPECT_TRUE(termination == 0 || termination == static_cast<int>(Termination::kTimeLimit));
    }
  }
}

TEST(VecEnvProgress, StaggeredMissionsEndAllAlongTheirLengthAndLeaveTheFirstTargetItsTime) {
  constexpr int kAircraft = 60;
  EnvConfig config = Mission("tracking");
  config.tracking.distance_ft = {30000, 40000};  // too far for six seconds
  config.stagger_clocks = true;
  VecEnv env(config, kAircraft, 1);
  std::vector<std::vector<float>> first;
  for (int i = 0; i < kAircraft; ++i) first.push_back(env.TargetOf(i));
  std::vector<bool> has_ended(kAircraft);
  std::vector<int> ends_by_third(3), first_missed;
  for (int step = 0; step < 100; ++step) {
    StepBuffers buffers(kAircraft);
    env.Step(0, buffers.action.data(), buffers.output());
    for (int i = 0; i < kAircraft; ++i) {
      if (has_ended[i]) continue;
      has_ended[i] = buffers.termination[i] != 0;
      if (has_ended[i]) ++ends_by_third[3 * step / 100];
      if (has_ended[i] || first[i].empty() || env.TargetOf(i) == first[i]) continue;
      first[i].clear();
      first_missed.push_back(step);
    }
  }
  for (const int ends : ends_by_third) EXPECT_GT(ends, kAircraft / 6);
  ASSERT_FALSE(first_missed.empty());
  for (const int step : first_missed) EXPECT_EQ(step, 33);  // the hundredth control step is in it
}

/// The altitude under which no target of a mission that began at 6000 ft may lead.
constexpr double kFloorFt = 2500 + 0.1 * (6000 - 2500);

EnvConfig LowMission(const std::string& task) {
  EnvConfig config = Mission(task);
  config.initial.altitude_ft = {6000, 6000};
  config.initial.true_airspeed_fps = {1000, 1000};
  config.time_limit_steps = 1000;
  return config;
}

TEST(VecEnvProgress, NoPitchOfAMissionLeadsIntoTheGroundByItsTimeLimit) {
  EnvConfig config = LowMission("control");
  config.control.pitch_change_rad = 0.5;
  config.control.pitch_tolerance_deg = config.control.yaw_tolerance_deg = 180;
  config.control.speed_tolerance_fps = 1000;
  VecEnv env(config, 32, 1);
  int limited = 0, targets = 0;
  std::vector<float> last(32, 9);
  for (int step = 0; step < 60; ++step) {
    for (int i = 0; i < 32; ++i) {
      const float pitch = env.TargetOf(i)[0];
      const double room = -env.StateOf(i, kDown) - kFloorFt;
      const double lowest = -std::asin(room / (1.3 * 1000 * 20));
      if (pitch != last[i]) {
        EXPECT_GE(pitch, lowest - 1e-3) << i;  // a policy step may have been flown since
        ++targets;
        limited += pitch < lowest + 1e-3;
      }
      last[i] = pitch;
    }
    Fly(&env, 1);
  }
  EXPECT_GE(targets, 64);
  EXPECT_GT(limited, targets / 8);  // without the limit four in ten were lower
  EXPECT_LT(limited, targets / 2);
}

TEST(VecEnvProgress, NoPointOfAMissionIsLowerThanATenthOfTheStartsHeight) {
  EnvConfig config = LowMission("tracking");
  config.tracking.distance_ft = {9000, 10000};
  config.tracking.position_tolerance_ft = 20000;
  VecEnv env(config, 32, 1);
  int limited = 0;
  for (int step = 0; step < 20; ++step) {
    for (int i = 0; i < 32; ++i) {
      const float altitude = env.TargetOf(i)[2];
      EXPECT_GE(altitude, static_cast<float>(kFloorFt)) << i;
      limited += altitude == static_cast<float>(kFloorFt);
    }
    Fly(&env, 1);
  }
  EXPECT_GT(limited, 0);
}

TEST(VecEnvProgress, PointsOfAMissionLieAheadOfWhereTheAircraftHasTurned) {
  constexpr int kAircraft = 8;
  constexpr double kAzimuthDeg = 5;
  EnvConfig config = Mission("tracking");
  config.action_repeat = 1;
  config.mission.length_s = 60;
  config.tracking.azimuth_deg = config.tracking.elevation_deg = kAzimuthDeg;
  config.time_limit_steps = 20;
  VecEnv env(config, kAircraft, 1);
  StepBuffers buffers(kAircraft);
  int turned = 0;
  for (int step = 0; step < 400; ++step) {
    for (std::size_t i = 0; i < kAircraft; ++i) {
      buffers.action[4 * i + 1] = step < 100 ? 0.0f : 0.5f;
      buffers.action[4 * i + 2] = step < 50 ? 0.4f : 0.0f;
    }
    std::vector<std::vector<float>> before;
    for (int i = 0; i < kAircraft; ++i) before.push_back(env.TargetOf(i));
    env.Step(0, buffers.action.data(), buffers.output());
    for (int i = 0; i < kAircraft; ++i) {
      const std::vector<float> point = env.TargetOf(i);
      if (buffers.termination[static_cast<std::size_t>(i)] != 0) continue;
      if (point == before[static_cast<std::size_t>(i)]) continue;
      const auto state = [&](int column) { return static_cast<double>(env.StateOf(i, column)); };
      const double yaw = EulerFromQuaternion({state(kQ0), state(kQx), state(kQy), state(kQz)}).yaw;
      const double bearing = std::atan2(point[1] - state(kEast), point[0] - state(kNorth));
      EXPECT_LE(std::abs(std::remainder(bearing - yaw, 2 * M_PI)),
                kAzimuthDeg / kDegPerRad + kBearing)
          << step;
      turned += std::abs(yaw) > 0.5;
    }
  }
  EXPECT_GT(turned, kAircraft);
}

TEST(VecEnvProgress, TargetsThatAreMissedAreFollowedByOthers) {
  EnvConfig config = Mission("heading");
  config.heading.speed_change_fps = 300;  // not within their time
  config.time_limit_steps = 30;
  VecEnv env(config, 1, 1);
  std::set<std::vector<float>> targets = {env.TargetOf(0)};
  for (int step = 0; step < 40; ++step) {
    Fly(&env, 1);
    targets.insert(env.TargetOf(0));
  }
  EXPECT_EQ(targets.size(), 5u) << "four were missed in 120 control steps";
}

TEST(VecEnvProgress, EveryTargetOfAMissionIsWorthATerminalReward) {
  EnvConfig config = Mission("control");
  config.reward = {};
  VecEnv env(config, 1, 1);
  const Log log = Fly(&env, 99);
  // A second of dwell each, and never out of the tolerances: five targets, the sixth at the end.
  int rewarded = 0;
  for (std::size_t i = 0; i < log.values.size(); i += 4) rewarded += log.values[i] > 100;
  EXPECT_EQ(rewarded, 5);
}

TEST(VecEnvProgress, ADwellDelaysSuccessByItsLengthAndAHoldByIts) {
  const auto steps_of = [](double dwell_s, double hold_s) {
    EnvConfig config = NearTargets("heading");
    config.action_repeat = 1;
    config.heading.dwell_s = dwell_s;
    config.hold_s = hold_s;
    VecEnv env(config, 4, 1);
    const Log log = Fly(&env, 130);
    return log.steps.empty() ? 0 : *std::min_element(log.steps.begin(), log.steps.end());
  };
  EXPECT_EQ(steps_of(0, 0), 1);
  EXPECT_EQ(steps_of(0.5, 0), 25);
  EXPECT_EQ(steps_of(0, 1), 51);
  EXPECT_EQ(steps_of(0.5, 1), 75);
}

TEST(VecEnvProgress, AHeldTargetIsWorthItsRewardOnceWhenItCounts) {
  EnvConfig nothing = NearTargets("heading");
  nothing.action_repeat = 1;
  nothing.heading.dwell_s = 0.1;
  nothing.hold_s = 0.5;
  nothing.termination.success_reward = 0;
  EnvConfig rewarded = nothing;
  rewarded.termination.success_reward = 700;
  VecEnv one(nothing, 1, 1), other(rewarded, 1, 1);
  const Log without = Fly(&one, 30), with = Fly(&other, 30);
  ASSERT_EQ(with.steps, std::vector<int>(1, 30));
  for (std::size_t step = 1; step <= 30; ++step) {
    const std::size_t i = 4 * (step - 1);  // a reward, and three numbers of the target
    EXPECT_NEAR(with.values[i] - without.values[i], step == 5 ? 700 : 0, kFloat32) << step;
  }
}

TEST(VecEnvProgress, PricesLowerTheRewardAndChangeNothingElse) {
  EnvConfig free = NearTargets("heading"), priced = free;
  free.heading.earliest_success_step = priced.heading.earliest_success_step = 300;
  priced.reward.roll_rate = 0.5;
  VecEnv one(free, 40, 1), other(priced, 40, 1);
  const Log cheap = Fly(&one, 20), dear = Fly(&other, 20);
  EXPECT_EQ(cheap.terminations, dear.terminations);
  for (int i = 0; i < 40; ++i) {
    for (int column = 0; column < kNumColumns; ++column) {
      EXPECT_EQ(one.StateOf(i, column), other.StateOf(i, column));
    }
  }
  for (std::size_t i = 0; i < cheap.values.size(); i += 4) {
    EXPECT_GT(cheap.values[i], dear.values[i]);
  }
}

/// What each of four aircraft pays in 50 control steps with one setting that costs and one that
/// does not.
std::vector<float> Paid(const EnvConfig& free, const EnvConfig& priced) {
  constexpr int kAircraft = 4, kSteps = 50;
  VecEnv one(free, kAircraft, 1), other(priced, kAircraft, 1);
  const Log cheap = Fly(&one, kSteps), dear = Fly(&other, kSteps);
  EXPECT_TRUE(cheap.steps.empty());
  std::vector<float> paid(kAircraft);
  for (std::size_t i = 0; i < cheap.values.size(); i += 4) {
    paid[i / 4 % kAircraft] += cheap.values[i] - dear.values[i];
  }
  return paid;
}

TEST(VecEnvProgress, APriceOnTimeIsPaidUntilTheTargetIsReached) {
  constexpr int kEarliest = 30, kDwell = 5;
  EnvConfig free = NearTargets("heading");
  free.action_repeat = 1;
  free.heading.earliest_success_step = kEarliest;
  free.heading.dwell_s = kDwell * free.control_interval_s;
  free.hold_s = 1;
  EnvConfig outside = free, before = free;
  outside.reward.outside_tolerances = 0.5;
  before.reward.before_reached = 0.5;
  for (const float sum : Paid(free, outside)) EXPECT_NEAR(sum, 0.5f * (kEarliest - 1), kFloat32);
  for (const float sum : Paid(free, before)) {
    EXPECT_NEAR(sum, 0.5f * (kEarliest - 1 + kDwell), kFloat32);
  }
}

TEST(VecEnvProgress, AMissedTargetCostsWhatTheTimeLimitDoes) {
  EnvConfig truncated = Mission("heading");
  truncated.heading.speed_change_fps = 300;  // not within two seconds
  truncated.truncate_at_time_limit = true;
  EnvConfig failed = truncated;
  failed.truncate_at_time_limit = false;
  for (const float sum : Paid(truncated, failed)) EXPECT_NEAR(sum, 200, kFloat32);
  failed.termination.late_reward_factor = 0.25;
  for (const float sum : Paid(truncated, failed)) EXPECT_NEAR(sum, 50, kFloat32);
}

TEST(VecEnvProgress, MissionsInTrainingFlyAsMissionsDoAndEvaluationsNoneOfThem) {
  for (const std::string& task : TaskNames()) {
    EnvConfig asked = Mission(task), trained = asked;
    asked.mission.length_s = 4;
    trained.mission.training_length_s = 4;
    VecEnv one(asked, 8, 1), other(trained, 8, 1);
    EXPECT_EQ(Fly(&one, 100), Fly(&other, 100)) << task;
    VecEnv evaluated(EvaluationConfig(trained), 8, 1), usual(Mission(task), 8, 1);
    EXPECT_EQ(Fly(&evaluated, 100), Fly(&usual, 100)) << task;
  }
}

TEST(VecEnvProgress, TargetsOfMissionsInTrainingAreMissedLaterWhileTheLimitGrows) {
  EnvConfig config = Mission("heading");
  config.heading.speed_change_fps = 300;  // not within two seconds
  config.time_limit_steps = 100;
  config.mission.training_length_s = 6;
  config.mission.training_time_limit_s = 0.4;
  for (const auto& [share, steps] : {std::pair{0.0, 20}, {0.5, 60}, {1.0, 100}}) {
    EnvConfig limited = config;
    limited.mission.training_time_limit_s = 0;
    limited.time_limit_steps = steps;
    VecEnv grown(config, 8, 1), same(limited, 8, 1);
    grown.SetTimeLimitShare(share);
    EXPECT_EQ(Fly(&grown, 100), Fly(&same, 100)) << share;
  }
}

TEST(VecEnvProgress, ActionsFlownWhileNothingIsPricedAreRemembered) {
  EnvConfig free = NearTargets("heading"), priced;
  free.heading.earliest_success_step = 300;
  priced = free;
  priced.reward.action_change = 1;
  VecEnv one(free, 4, 1), other(priced, 4, 1);
  StepBuffers expected(4), flown(4);
  const auto step = [&](float pitch) {
    for (StepBuffers* const buffers : {&expected, &flown}) {
      for (std::size_t i = 0; i < 4; ++i) buffers->action[4 * i + 1] = pitch;
    }
    one.Step(0, expected.action.data(), expected.output());
    other.Step(0, flown.action.data(), flown.output());
  };
  other.SetHandlingWeight(0);
  step(0.5f);
  EXPECT_EQ(flown.reward, expected.reward);
  other.SetHandlingWeight(1);
  step(0.5f);
  EXPECT_EQ(flown.reward, expected.reward);
  step(0.25f);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(flown.reward[i], expected.reward[i]);
}

TEST(VecEnvProgress, AnEpisodesFirstActionIsAChangeFromCentredSticks) {
  EnvConfig free = NearTargets("heading");
  free.time_limit_steps = free.heading.earliest_success_step = free.action_repeat;
  EnvConfig priced = free;
  priced.reward.action_change = 1;
  VecEnv one(free, 4, 1), other(priced, 4, 1);
  for (int episode = 0; episode < 3; ++episode) {
    StepBuffers expected(4), flown(4);
    for (std::size_t i = 0; i < 4; ++i) {
      expected.action[4 * i + 1] = flown.action[4 * i + 1] = 0.5f;
    }
    one.Step(0, expected.action.data(), expected.output());
    other.Step(0, flown.action.data(), flown.output());
    for (std::size_t i = 0; i < 4; ++i) {
      ASSERT_NE(flown.termination[i], 0);
      EXPECT_NEAR(expected.reward[i] - flown.reward[i], 0.25, kFloat32) << episode;
    }
  }
}

TEST(VecEnvProgress, TimesOfNoControlStepOrMoreThanCanBeCountedAreRefused) {
  EnvConfig config;
  for (double* const time :
       {&config.hold_s, &config.heading.dwell_s, &config.control.dwell_s, &config.mission.length_s,
        &config.mission.dwell_s, &config.mission.training_length_s,
        &config.mission.training_time_limit_s}) {
    if (time == &config.mission.training_time_limit_s) config.mission.training_length_s = 1;
    const double usual = *time;
    for (const double seconds : {0.009, 1e8, 1e300}) {
      *time = seconds;
      EXPECT_THROW(Validate(config), Error) << seconds;
    }
    *time = 0.02;
    EXPECT_NO_THROW(Validate(config));
    *time = usual;
  }
}

TEST(VecEnvProgress, APointCannotBeHeld) {
  EnvConfig config;
  config.task = "tracking";
  config.hold_s = 1;
  EXPECT_THROW(VecEnv(config, 1, 1), Error);
  config.task = "heading";
  EXPECT_NO_THROW(VecEnv(config, 1, 1));
  config.mission.length_s = 60;
  EXPECT_THROW(VecEnv(config, 1, 1), Error);
}

}  // namespace
}  // namespace skein
