// SPDX-License-Identifier: Apache-2.0
#include "envs/vec_env.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/worker_pool.h"
#include "envs/aircraft/f16.h"
#include "envs/reference/closed_loop.h"
#include "envs/state/attitude.h"
#include "envs/task_registry.h"
#include "simd/random.h"
#include "tests/envs/plant/drawn_plants.h"
#include "tests/envs/step_buffers.h"
#include "tests/scoped_target.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr int kSize = 22;

/// Actions that depend on nothing but the aircraft and the policy step.
std::array<float, 4> ActionOf(int aircraft, int policy_step) {
  simd::RandomStream random({9, static_cast<std::uint32_t>(aircraft),
                             static_cast<std::uint32_t>(policy_step / 10), 0,
                             simd::RandomPurpose::kActionNoise});
  std::array<float, 4> action;
  for (float& value : action) value = static_cast<float>(random.Uniform(-1, 1));
  action[1] *= 0.4f;  // few overloads: long flights
  return action;
}

/// Everything that a run of policy steps gave to one aircraft.
struct Log {
  std::vector<float> observations, rewards, returns;
  std::vector<int> terminations, steps;

  bool operator==(const Log& other) const {
    return observations == other.observations && rewards == other.rewards &&
           returns == other.returns && terminations == other.terminations && steps == other.steps;
  }
};

void FlyTile(VecEnv* env, int tile, int first_policy_step, int policy_steps,
             std::vector<Log>* logs) {
  const int count = env->tile_count(tile), begin = env->tile_begin(tile);
  StepBuffers buffers(count);
  for (int policy_step = first_policy_step; policy_step < first_policy_step + policy_steps;
       ++policy_step) {
    env->Observe(tile, buffers.observation.data());
    for (int i = 0; i < count; ++i) {
      const std::array<float, 4> action = ActionOf(begin + i, policy_step);
      std::copy(action.begin(), action.end(), buffers.action.begin() + i * 4);
    }
    env->Step(tile, buffers.action.data(), buffers.output());
    for (int i = 0; i < count; ++i) {
      const auto index = static_cast<std::size_t>(i);
      Log& log = (*logs)[static_cast<std::size_t>(begin + i)];
      log.observations.insert(log.observations.end(), buffers.observation.begin() + i * kSize,
                              buffers.observation.begin() + (i + 1) * kSize);
      log.rewards.push_back(buffers.reward[index]);
      log.terminations.push_back(buffers.termination[index]);
      if (buffers.termination[index] == 0) continue;
      log.returns.push_back(buffers.episode_return[index]);
      log.steps.push_back(buffers.episode_steps[index]);
    }
  }
}

std::vector<Log> Fly(VecEnv* env, int first_policy_step, int policy_steps) {
  std::vector<Log> logs(static_cast<std::size_t>(env->num_aircraft()));
  for (int tile = 0; tile < env->num_tiles(); ++tile) {
    FlyTile(env, tile, first_policy_step, policy_steps, &logs);
  }
  return logs;
}

/// Short episodes with many ends.
EnvConfig BusyConfig() {
  EnvConfig config;
  config.action_repeat = 3;
  config.time_limit_steps = config.heading.earliest_success_step = 100;
  config.stagger_clocks = true;
  return config;
}

TEST(VecEnv, ResultsDoNotDependOnTheTileSize) {
  VecEnv small(BusyConfig(), 300, 1, 32), middle(BusyConfig(), 300, 1, 160),
      large(BusyConfig(), 300, 1, 4096);
  EXPECT_EQ(small.num_tiles(), 10);
  EXPECT_EQ(large.num_tiles(), 1);
  const std::vector<Log> logs = Fly(&small, 0, 60);
  EXPECT_EQ(logs, Fly(&middle, 0, 60));
  EXPECT_EQ(logs, Fly(&large, 0, 60));
  EXPECT_EQ(small.Snapshot(), large.Snapshot());
}

TEST(VecEnv, NoTaskDependsOnTheTileSizeAndEverySnapshotGoesOn) {
  for (const std::string& task : TaskNames()) {
    EnvConfig config = BusyConfig();
    config.task = task;
    VecEnv small(config, 70, 1, 32), large(config, 70, 1, 4096);
    EXPECT_EQ(Fly(&small, 0, 40), Fly(&large, 0, 40)) << task;
    const std::vector<std::uint32_t> snapshot = small.Snapshot();
    EXPECT_EQ(snapshot, large.Snapshot()) << task;
    VecEnv other(config, 70, 1);
    other.Restore(snapshot);
    EXPECT_EQ(Fly(&other, 40, 20), Fly(&small, 40, 20)) << task;
  }
}

TEST(VecEnv, NeitherDoWindAndNoiseByEpisode) {
  EnvConfig config = BusyConfig();
  config.wind.speed_fps = {0, 120};
  config.wind.turbulence_fps = {0, 20};
  config.observation_noise_max = 0.1;
  VecEnv small(config, 70, 1, 32), large(config, 70, 1, 4096);
  EXPECT_EQ(Fly(&small, 0, 40), Fly(&large, 0, 40));
  const std::vector<std::uint32_t> snapshot = small.Snapshot();
  EXPECT_EQ(snapshot, large.Snapshot());
  VecEnv other(config, 70, 1);
  other.Restore(snapshot);
  EXPECT_EQ(Fly(&other, 40, 20), Fly(&small, 40, 20));
}

TEST(VecEnv, NeitherDoDrawnPlants) {
  for (const std::string& task : TaskNames()) {
    for (const double turbulence_fps : {0.0, 10.0}) {
      EnvConfig config = BusyConfig();
      config.task = task;
      config.plant = DrawnPlants();
      config.wind.turbulence_fps = {0, turbulence_fps};
      VecEnv small(config, 70, 1, 32), large(config, 70, 1, 4096), few(config, 5, 1);
      const std::vector<Log> logs = Fly(&small, 0, 41);
      EXPECT_EQ(logs, Fly(&large, 0, 41)) << task;
      const std::vector<Log> few_logs = Fly(&few, 0, 41);
      EXPECT_TRUE(std::equal(few_logs.begin(), few_logs.end(), logs.begin())) << task;
      const std::vector<std::uint32_t> snapshot = small.Snapshot();
      EXPECT_EQ(snapshot, large.Snapshot()) << task;
      // Into an environment in the midst of other flights.
      VecEnv other(config, 70, 1);
      Fly(&other, 0, 7);
      other.Restore(snapshot);
      EXPECT_EQ(other.Snapshot(), snapshot) << task;
      EXPECT_EQ(Fly(&other, 41, 20), Fly(&small, 41, 20)) << task;
    }
  }
}

TEST(VecEnv, ResultsDoNotDependOnOtherAircraft) {
  VecEnv few(BusyConfig(), 5, 1), many(BusyConfig(), 200, 1);
  const std::vector<Log> few_logs = Fly(&few, 0, 60);
  std::vector<Log> many_logs = Fly(&many, 0, 60);
  many_logs.resize(few_logs.size());
  EXPECT_EQ(few_logs, many_logs);
}

TEST(VecEnv, ResultsDoNotDependOnThreads) {
  EnvConfig drawn = BusyConfig();
  drawn.plant = DrawnPlants();
  drawn.wind.turbulence_fps = {0, 10};
  for (const EnvConfig& config : {BusyConfig(), drawn}) {
    VecEnv serial(config, 300, 1, 32), parallel(config, 300, 1, 32);
    const std::vector<Log> expected = Fly(&serial, 0, 60);
    WorkerPool pool(4);
    std::vector<Log> logs(expected.size());
    pool.ForEach(parallel.num_tiles(),
                 [&](int tile, int) { FlyTile(&parallel, tile, 0, 60, &logs); });
    EXPECT_EQ(expected, logs) << config.plant.enabled();
  }
}

TEST(VecEnv, SeedsGiveDifferentFlights) {
  VecEnv one(BusyConfig(), 4, 1), two(BusyConfig(), 4, 2);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NE(one.StateOf(i, kDown), two.StateOf(i, kDown));
    EXPECT_NE(one.TargetOf(i), two.TargetOf(i));
  }
  EXPECT_NE(one.StateOf(0, kDown), one.StateOf(1, kDown));
}

TEST(VecEnv, SnapshotContinuesBitForBit) {
  VecEnv env(BusyConfig(), 70, 1, 64);
  Fly(&env, 0, 40);
  const std::vector<std::uint32_t> snapshot = env.Snapshot();
  const std::vector<Log> expected = Fly(&env, 40, 40);
  VecEnv other(BusyConfig(), 70, 1, 32);
  Fly(&other, 0, 7);
  other.Restore(snapshot);
  EXPECT_EQ(other.Snapshot(), snapshot);
  EXPECT_EQ(Fly(&other, 40, 40), expected);
  VecEnv smaller(BusyConfig(), 69, 1);
  EXPECT_THROW(smaller.Restore(snapshot), Error);
}

TEST(VecEnv, ScalarAndVectorTargetsAgree) {
  // Of observations near one; rounding is 1e-7, with fused against separate multiply-add.
  constexpr Tolerance kAmplified{5e-4, "float32 rounding, amplified by a second of flight"};
  EnvConfig config;
  std::vector<std::vector<Log>> logs;
  for (const simd::Target target : simd::SupportedTargets()) {
    const ScopedTarget scoped(target);
    VecEnv env(config, 64, 1);
    logs.push_back(Fly(&env, 0, 50));
  }
  for (const std::vector<Log>& other : logs) {
    for (std::size_t i = 0; i < other.size(); ++i) {
      ASSERT_EQ(other[i].observations.size(), logs[0][i].observations.size());
      for (std::size_t k = 0; k < other[i].observations.size(); ++k) {
        ASSERT_NEAR(other[i].observations[k], logs[0][i].observations[k], kAmplified)
            << "aircraft " << i << ", policy step " << k / kSize << ", element " << k % kSize;
      }
    }
  }
}

TEST(VecEnv, FliesLikeTheClosedLoopInDoublePrecision) {
  constexpr Tolerance kVelocity{0.02, "float32 over two seconds, amplified by the pitch loop"};
  constexpr Tolerance kRate{2e-4, "float32 over two seconds, amplified by the pitch loop"};
  constexpr Tolerance kPosition{0.1, "float32 of 20,000 ft, 2e-3 ft a step"};
  constexpr Tolerance kSurface{0.02, "float32 integrators, amplified by the pitch loop"};
  EnvConfig config;
  config.initial.altitude_ft = {20000, 20000};
  config.initial.true_airspeed_fps = {1100, 1100};
  const Plant plant(F16(), config.atmosphere);
  const TrimPoint trim = Trim(plant, {20000, 1100, 0, 0});
  constexpr int kCount = 8;
  VecEnv env(config, kCount, 1);
  std::vector<ClosedLoop> expected;
  for (int i = 0; i < kCount; ++i) {
    expected.emplace_back(plant, trim, config.flight_control, config.control_interval_s);
  }
  StepBuffers buffers(kCount);
  for (int step = 0; step < 100; ++step) {
    for (int i = 0; i < kCount; ++i) {
      const std::array<float, 4> action = ActionOf(i, step / 2);
      std::copy(action.begin(), action.end(), buffers.action.begin() + i * 4);
      expected[static_cast<std::size_t>(i)].Step(
          {0.5 * (action[0] + 1), action[1], action[2], action[3]});
    }
    env.Step(0, buffers.action.data(), buffers.output());
    for (int i = 0; i < kCount; ++i) {
      ASSERT_EQ(buffers.termination[static_cast<std::size_t>(i)], 0);
      const ClosedLoop& loop = expected[static_cast<std::size_t>(i)];
      const auto near = [&](int column, double value, double tolerance) {
        ASSERT_NEAR(env.StateOf(i, column), value, tolerance)
            << "step " << step << ", aircraft " << i << ", column " << column;
      };
      for (const int column : {kU, kV, kW}) near(column, loop.state()[column], kVelocity);
      for (const int column : {kP, kQ, kR}) near(column, loop.state()[column], kRate);
      for (const int column : {kNorth, kEast, kDown}) {
        near(column, loop.state()[column], kPosition);
      }
      for (const int column : {kQ0, kQx, kQy, kQz}) {
        near(column, loop.state()[column], kRate);
      }
      near(kPower, loop.power(), kSurface);
      near(kElevator, loop.surfaces().elevator_deg, kSurface);
      near(kAileron, loop.surfaces().aileron_deg, kSurface);
      near(kRudder, loop.surfaces().rudder_deg, kSurface);
      near(kLeadingEdgeFlap, loop.surfaces().leading_edge_flap_deg, kSurface);
      near(kNz, loop.nz(), kSurface);
    }
  }
}

TEST(VecEnv, TrimmedStartsStayTrimmedHandsOff) {
  constexpr Tolerance kFloat32Start{0.01, "float32 rounding of 20,000 ft"};
  constexpr Tolerance kSteady{0.02, "trims between nodes, over 0.2 s"};
  constexpr Tolerance kLoadFactor{2e-3, "trims between nodes"};
  constexpr Tolerance kRollRate{3e-4, "trims between nodes"};
  EnvConfig config;
  constexpr int kCount = 256;
  VecEnv env(config, kCount, 3);
  std::vector<float> speed(kCount), altitude(kCount);
  for (int i = 0; i < kCount; ++i) {
    speed[static_cast<std::size_t>(i)] = std::hypot(env.StateOf(i, kU), env.StateOf(i, kW));
    altitude[static_cast<std::size_t>(i)] = -env.StateOf(i, kDown);
    EXPECT_GE(altitude[static_cast<std::size_t>(i)], 19000 - kFloat32Start);
    EXPECT_LE(altitude[static_cast<std::size_t>(i)], 20000 + kFloat32Start);
    EXPECT_GE(speed[static_cast<std::size_t>(i)], 1000 - kFloat32Start);
    EXPECT_LE(speed[static_cast<std::size_t>(i)], 1200 + kFloat32Start);
  }
  // 0.2 s: thrust stays that of the trim by giving each aircraft its own throttle.
  StepBuffers buffers(kCount);
  for (int i = 0; i < kCount; ++i) {
    const float power = env.StateOf(i, kPower);
    const float throttle = power <= 50 ? power / 64.94f : (power + 117.38f) / 217.38f;
    buffers.action[static_cast<std::size_t>(i) * 4] = 2 * throttle - 1;
  }
  for (int step = 0; step < 10; ++step) env.Step(0, buffers.action.data(), buffers.output());
  for (int i = 0; i < kCount; ++i) {
    EXPECT_NEAR(std::hypot(env.StateOf(i, kU), env.StateOf(i, kW)),
                speed[static_cast<std::size_t>(i)], kSteady);
    EXPECT_NEAR(-env.StateOf(i, kDown), altitude[static_cast<std::size_t>(i)], kSteady);
    EXPECT_NEAR(env.StateOf(i, kNz), 1, kLoadFactor);
    EXPECT_NEAR(env.StateOf(i, kP), 0, kRollRate);
  }
}

TEST(VecEnv, UntrimmedStartsAreThePapers) {
  EnvConfig config;
  config.initial.trimmed = false;
  VecEnv env(config, 3, 3);
  for (int i = 0; i < 3; ++i) {
    for (const int column : {kV, kW, kP, kQ, kR, kNorth, kEast, kQx, kQy, kQz, kElevator, kAileron,
                             kRudder, kLeadingEdgeFlap}) {
      EXPECT_EQ(env.StateOf(i, column), 0) << column;
    }
    EXPECT_EQ(env.StateOf(i, kQ0), 1);
    EXPECT_GT(env.StateOf(i, kPower), 0);
  }
  Fly(&env, 0, 20);
}

TEST(VecEnv, TimeLimitEndsAndRestartsEveryEpisode) {
  EnvConfig config;
  config.time_limit_steps = config.heading.earliest_success_step = 20;
  config.action_repeat = 8;
  VecEnv env(config, 10, 1);
  const std::vector<float> first_target = env.TargetOf(0);
  StepBuffers buffers(10);
  for (int policy_step = 0; policy_step < 9; ++policy_step) {
    env.Step(0, buffers.action.data(), buffers.output());
    const bool ends = policy_step % 3 == 2;
    for (std::size_t i = 0; i < 10; ++i) {
      EXPECT_EQ(buffers.termination[i],
                static_cast<int>(ends ? Termination::kTimeLimit : Termination::kNone));
      if (!ends) continue;
      EXPECT_EQ(buffers.episode_steps[i], 20);
      EXPECT_LT(buffers.reward[i], -200);
      EXPECT_LT(buffers.episode_return[i], buffers.reward[i]);
      EXPECT_GT(buffers.reward[i], -200 - 4 * 5);  // four steps counted in the last policy step
      EXPECT_EQ(env.StateOf(static_cast<int>(i), kNorth), 0);
    }
  }
  EXPECT_NE(env.TargetOf(0), first_target);
}

TEST(VecEnv, ControlEndsAtItsTargetAtOnce) {
  // A target where the flight begins: a control step from trim moves neither nose nor speed, and
  // the trimmed bank is below a tenth of a degree.
  constexpr float kFarthest = 0.01f;
  EnvConfig config;
  config.task = "control";
  config.control.pitch_change_rad = config.control.yaw_change_rad =
      config.control.speed_change_fps = 0;
  VecEnv env(config, 3, 1);
  StepBuffers buffers(3);
  env.Step(0, buffers.action.data(), buffers.output());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(buffers.termination[i], static_cast<int>(Termination::kTargetReached));
    EXPECT_LE(buffers.reward[i], 200);
    EXPECT_GT(buffers.reward[i], 200 - kFarthest * (1 + 5));
    EXPECT_EQ(buffers.episode_steps[i], 1);
  }
}

TEST(VecEnv, ControlFailsAtItsTimeLimit) {
  EnvConfig config;
  config.task = "control";
  config.control.pitch_change_rad = config.control.yaw_change_rad = 0;
  config.control.speed_change_fps = 300;
  config.control.speed_tolerance_fps = 1e-3;
  config.time_limit_steps = 10;
  config.action_repeat = 10;
  VecEnv env(config, 40, 1);
  // Ten steps of about 5 x speed error / 340 m/s.
  constexpr Tolerance kSlowing{10 * 5 * 10 / (340 / 0.3048), "idle slows by less than 10 ft/s"};
  std::vector<double> expected;
  for (int i = 0; i < 40; ++i) {
    const double speed = std::hypot(env.StateOf(i, kU), env.StateOf(i, kV), env.StateOf(i, kW));
    expected.push_back(-10 * 5 * std::abs(env.TargetOf(i)[2] - speed) / (340 / 0.3048));
  }
  StepBuffers buffers(40);
  for (std::size_t i = 0; i < 40; ++i) buffers.action[4 * i] = -1;
  env.Step(0, buffers.action.data(), buffers.output());
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(buffers.termination[i], static_cast<int>(Termination::kTimeLimit));
    EXPECT_NEAR(buffers.reward[i], -200 + expected[i], kSlowing) << i;
  }
}

TEST(VecEnv, ReturnIsTheSumOfRewards) {
  EnvConfig config;
  config.time_limit_steps = config.heading.earliest_success_step = 50;
  config.action_repeat = 5;
  VecEnv env(config, 40, 1);
  const std::vector<Log> logs = Fly(&env, 0, 10);
  for (const Log& log : logs) {
    double sum = 0;
    for (const float reward : log.rewards) sum += reward;
    ASSERT_EQ(log.returns.size(), 1u);
    constexpr Tolerance kFloat32Sum{1e-3, "a float32 sum of rewards"};
    EXPECT_NEAR(log.returns[0], sum, kFloat32Sum);
  }
}

TEST(VecEnv, TruncationKeepsTheLastObservation) {
  EnvConfig config;
  config.time_limit_steps = config.heading.earliest_success_step = 10;
  config.action_repeat = 10;
  config.truncate_at_time_limit = true;
  constexpr int kCount = 150;
  VecEnv env(config, kCount, 1);
  // The same flight with a later limit shows the same observation there.
  EnvConfig longer = config;
  longer.time_limit_steps = 1000;
  VecEnv reference(longer, kCount, 1);
  StepBuffers buffers(kCount), reference_buffers(kCount);
  const auto size = static_cast<std::size_t>(env.privileged_size());
  std::vector<float> final_privileged(kCount * size), privileged(kCount * size);
  StepOutput output = buffers.output();
  output.final_privileged = final_privileged.data();
  env.Step(0, buffers.action.data(), output);
  reference.Step(0, reference_buffers.action.data(), reference_buffers.output());
  reference.Observe(0, reference_buffers.observation.data());
  reference.ObservePrivileged(0, privileged.data());
  EXPECT_EQ(buffers.final_observation, reference_buffers.observation);
  constexpr std::size_t kClock = 3;
  for (std::size_t i = 0; i < kCount; ++i) {
    EXPECT_EQ(final_privileged[i * size + kClock], 1) << "the time is up";
    privileged[i * size + kClock] = 1;
  }
  EXPECT_EQ(final_privileged, privileged);
  EXPECT_EQ(buffers.reward, reference_buffers.reward);
  for (const std::uint8_t termination : buffers.termination) {
    EXPECT_EQ(termination, static_cast<int>(Termination::kTimeLimit));
  }
}

TEST(VecEnv, StaggeredClocksSpreadOverTheTimeLimit) {
  EnvConfig config;
  config.time_limit_steps = config.heading.earliest_success_step = 40;
  config.stagger_clocks = true;
  constexpr int kCount = 4000;
  VecEnv env(config, kCount, 1, kCount);
  StepBuffers buffers(kCount);
  std::vector<int> first_end(kCount, -1);
  for (int step = 0; step < 40; ++step) {
    env.Step(0, buffers.action.data(), buffers.output());
    for (std::size_t i = 0; i < kCount; ++i) {
      if (buffers.termination[i] != 0 && first_end[i] < 0) first_end[i] = step;
    }
  }
  std::array<int, 40> ends{};
  for (const int end : first_end) {
    ASSERT_GE(end, 0);
    ++ends[static_cast<std::size_t>(end)];
  }
  for (const int count : ends) EXPECT_NEAR(count, 100, 1.2 * kStandardErrors * std::sqrt(100.0));
}

/// Replaces one float of one aircraft's state.
void Inject(VecEnv* env, int aircraft, int column, float value) {
  std::vector<std::uint32_t> snapshot = env->Snapshot();
  const std::size_t words = snapshot.size() / static_cast<std::size_t>(env->num_aircraft());
  std::memcpy(
      &snapshot[static_cast<std::size_t>(aircraft) * words + static_cast<std::size_t>(column)],
      &value, sizeof value);
  env->Restore(snapshot);
}

TEST(VecEnv, NonFiniteStateEndsOnlyItsOwnEpisode) {
  constexpr int kCount = 96, kSick = 41;
  for (const int column : {kU, kQ, kDown, kQx, kPower, kElevator, kPitchIntegrator, kNz}) {
    VecEnv env(EnvConfig{}, kCount, 1), healthy(EnvConfig{}, kCount, 1);
    Inject(&env, kSick, column, std::numeric_limits<float>::quiet_NaN());
    const std::vector<Log> logs = Fly(&env, 0, 5), expected = Fly(&healthy, 0, 5);
    for (std::size_t i = 0; i < kCount; ++i) {
      if (i != kSick) {
        EXPECT_EQ(logs[i], expected[i]);
        continue;
      }
      // At once, or one step later where the value acts through others first.
      const std::vector<int>& terminations = logs[i].terminations;
      EXPECT_EQ(std::count(terminations.begin(), terminations.end(),
                           static_cast<int>(Termination::kNonFinite)),
                1)
          << "column " << column;
      for (const float reward : logs[i].rewards) EXPECT_TRUE(std::isfinite(reward));
      for (const float value : {env.StateOf(kSick, kU), env.StateOf(kSick, column)}) {
        EXPECT_TRUE(std::isfinite(value));
      }
    }
  }
}

TEST(VecEnv, NonFiniteActionIsNonFinite) {
  VecEnv env(EnvConfig{}, 40, 1);
  StepBuffers buffers(40);
  buffers.action[3 * 4 + 2] = std::numeric_limits<float>::quiet_NaN();
  buffers.action[5 * 4] = std::numeric_limits<float>::infinity();
  env.Step(0, buffers.action.data(), buffers.output());
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(buffers.termination[i],
              static_cast<int>(i == 3 || i == 5 ? Termination::kNonFinite : Termination::kNone));
  }
}

TEST(VecEnv, ActionsAreClipped) {
  VecEnv one(EnvConfig{}, 2, 1), two(EnvConfig{}, 2, 1);
  StepBuffers clipped(2), beyond(2);
  clipped.action = {1, -1, 1, 1, -1, 1, -1, -1};
  beyond.action = {3, -1.5f, 9, 1.01f, -4, 2, -7, -1e20f};
  for (int step = 0; step < 10; ++step) {
    one.Step(0, clipped.action.data(), clipped.output());
    two.Step(0, beyond.action.data(), beyond.output());
  }
  EXPECT_EQ(one.Snapshot(), two.Snapshot());
}

TEST(VecEnv, NoiseHasTheConfiguredScaleAndIsNewEveryStep) {
  EnvConfig clean_config, noisy_config;
  clean_config.observation_noise = 0;
  noisy_config.observation_noise = 0.05;
  constexpr int kCount = 500;
  VecEnv clean(clean_config, kCount, 1, kCount), noisy(noisy_config, kCount, 1, kCount);
  StepBuffers clean_buffers(kCount), noisy_buffers(kCount);
  std::vector<double> previous;
  for (int step = 0; step < 3; ++step) {
    clean.Observe(0, clean_buffers.observation.data());
    noisy.Observe(0, noisy_buffers.observation.data());
    std::vector<double> noise;
    double squares = 0, product = 0;
    for (std::size_t k = 0; k < clean_buffers.observation.size(); ++k) {
      noise.push_back(noisy_buffers.observation[k] - clean_buffers.observation[k]);
      squares += noise[k] * noise[k];
      if (!previous.empty()) product += noise[k] * previous[k];
    }
    const double n = static_cast<double>(noise.size());
    EXPECT_NEAR(std::sqrt(squares / n), 0.05, kStandardErrors * 0.05 / std::sqrt(2 * n));
    EXPECT_NEAR(product / n, 0, kStandardErrors * 0.05 * 0.05 / std::sqrt(n));
    previous = noise;
    clean.Step(0, clean_buffers.action.data(), clean_buffers.output());
    noisy.Step(0, noisy_buffers.action.data(), noisy_buffers.output());
  }
}

TEST(VecEnv, RefusesWhatCannotBeFlown) {
  const auto message = [](EnvConfig config, int aircraft = 1, int tile = 256) {
    try {
      VecEnv env(config, aircraft, 1, tile);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EnvConfig config;
  EXPECT_EQ(message(config), "");
  EXPECT_NE(message(config, 0).find("aircraft"), std::string::npos);
  EXPECT_NE(message(config, 1, 0).find("tile"), std::string::npos);
  config.task = "loiter";
  EXPECT_NE(message(config).find("known: heading, control"), std::string::npos);
  config = {};
  config.aircraft = "f15";
  EXPECT_NE(message(config).find("known: aerosonde, cessna172, f16"), std::string::npos);
  config = {};
  config.action_repeat = 0;
  EXPECT_NE(message(config).find("action_repeat"), std::string::npos);
  config = {};
  config.initial.altitude_ft = {20000, 19000};
  EXPECT_NE(message(config).find("env.initial.altitude_min_ft"), std::string::npos);
  config = {};
  config.observation_noise = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message(config).find("observation_noise"), std::string::npos);
}

}  // namespace
}  // namespace skein
