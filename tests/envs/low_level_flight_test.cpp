// SPDX-License-Identifier: Apache-2.0
#include "envs/low_level_flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/worker_pool.h"
#include "envs/state/attitude.h"
#include "envs/tasks/control.h"
#include "envs/vec_env.h"
#include "simd/random.h"
#include "tests/envs/plant/drawn_plants.h"
#include "tests/envs/step_buffers.h"
#include "tests/envs/test_policy.h"
#include "tests/envs/test_tile.h"
#include "tests/scoped_target.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr double kSpeedUnit = 340 / 0.3048;
constexpr int kSize = kObservationSize;

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

/// Short episodes: four policy steps of 20 control steps.
EnvConfig Config() {
  EnvConfig config;
  config.task = "tracking";
  config.action_repeat = 20;
  config.time_limit_steps = 80;
  return config;
}

std::shared_ptr<const Policy> LowLevelPolicy(int action_repeat = 4) {
  return std::make_shared<const TestPolicy>(action_repeat);
}

/// High-level actions that depend on nothing but the aircraft and the policy step; some beyond
/// full.
std::array<float, kHighLevelActionSize> HighLevelActionOf(int aircraft, int policy_step) {
  simd::RandomStream random({9, static_cast<std::uint32_t>(aircraft),
                             static_cast<std::uint32_t>(policy_step), 0,
                             simd::RandomPurpose::kActionNoise});
  std::array<float, kHighLevelActionSize> action;
  for (float& value : action) value = static_cast<float>(random.Uniform(-1.2, 1.2));
  return action;
}

/// All observations and rewards, aircraft by aircraft.
using Log = std::vector<std::vector<float>>;

void FlyTile(VecEnv* env, int tile, int first_policy_step, int policy_steps, Log* log) {
  const int count = env->tile_count(tile), begin = env->tile_begin(tile);
  StepBuffers buffers(count, kHighLevelActionSize);
  for (int policy_step = first_policy_step; policy_step < first_policy_step + policy_steps;
       ++policy_step) {
    env->Observe(tile, buffers.observation.data());
    for (int i = 0; i < count; ++i) {
      const auto action = HighLevelActionOf(begin + i, policy_step);
      std::copy(action.begin(), action.end(), buffers.action.begin() + i * kHighLevelActionSize);
    }
    env->Step(tile, buffers.action.data(), buffers.output());
    for (int i = 0; i < count; ++i) {
      std::vector<float>& own = (*log)[Index(begin + i)];
      own.insert(own.end(), buffers.observation.begin() + i * kSize,
                 buffers.observation.begin() + (i + 1) * kSize);
      own.push_back(buffers.reward[Index(i)]);
      own.push_back(buffers.termination[Index(i)]);
    }
  }
}

Log Fly(VecEnv* env, int first_policy_step, int policy_steps) {
  Log log(Index(env->num_aircraft()));
  for (int tile = 0; tile < env->num_tiles(); ++tile) {
    FlyTile(env, tile, first_policy_step, policy_steps, &log);
  }
  return log;
}

/// The hierarchy as two plain loops around an environment that takes throttle and sticks: an outer
/// one that sets targets, an inner one in which the low-level policy observes their errors.
class TwoLoops {
 public:
  TwoLoops(const EnvConfig& config, int count, std::uint64_t seed, const Policy& low_level)
      : config_(config),
        count_(count),
        low_level_(low_level),
        env_(SingleStepConfig(config), count, seed, count),
        clean_(CleanConfig(config), count, seed, count),
        memory_(Index(count * low_level.state_size())) {}

  /// What the high-level policy is to observe, row-major.
  std::vector<float> Observe() {
    StepBuffers now(count_, kActionSize);
    env_.Observe(0, now.observation.data());
    for (int i = 0; i < count_; ++i) {
      for (int k = 0; k < kSize; ++k) {
        float& value = now.observation[Index(i * kSize + k)];
        value = static_cast<float>((value + observation_sums_[Index(i * kSize + k)]) /
                                   (num_samples_[Index(i)] + 1));
      }
    }
    return now.observation;
  }

  /// Rewards of one policy step.
  std::vector<double> Step(int policy_step) {
    std::vector<double> reward(Index(count_));
    std::vector<std::array<double, 3>> targets;
    for (int i = 0; i < count_; ++i)
      targets.push_back(TargetOf(i, HighLevelActionOf(i, policy_step)));
    StepBuffers buffers(count_, kActionSize), clean(count_, kActionSize);
    observation_sums_.assign(Index(count_ * kSize), 0);
    num_samples_.assign(Index(count_), 0);
    for (int step = 0; step < config_.action_repeat; ++step) {
      if (step % low_level_.action_repeat() == 0) {
        env_.Observe(0, buffers.observation.data());
        if (config_.high_level.averages_observations && step > 0) {
          for (std::size_t k = 0; k < observation_sums_.size(); ++k)
            observation_sums_[k] += buffers.observation[k];
          for (int& samples : num_samples_) ++samples;
        }
        clean_.Observe(0, clean.observation.data());
        for (int i = 0; i < count_; ++i) {
          const std::array<double, 3> errors = ErrorsOf(i, targets[Index(i)]);
          for (int k = 0; k < 3; ++k) {
            const auto at = Index(i * kSize + k);
            // The task's own errors go, and their noise stays.
            buffers.observation[at] += static_cast<float>(errors[Index(k)]) - clean.observation[at];
          }
        }
        low_level_.Act(count_, buffers.observation.data(), memory_.data(), buffers.action.data());
      }
      env_.Step(0, buffers.action.data(), buffers.output());
      clean_.Step(0, buffers.action.data(), clean.output());
      for (int i = 0; i < count_; ++i) {
        reward[Index(i)] += buffers.reward[Index(i)];
        const auto end = static_cast<Termination>(buffers.termination[Index(i)]);
        if (end == Termination::kNone) continue;
        // Elsewhere a new episode would have to wait for the end of the policy step.
        EXPECT_EQ(end, Termination::kTimeLimit);
        EXPECT_EQ(step + 1, config_.action_repeat);
        ++ends_;
        std::fill_n(memory_.begin() + i * low_level_.state_size(), low_level_.state_size(), 0.0f);
        std::fill_n(observation_sums_.begin() + i * kSize, kSize, 0);
        num_samples_[Index(i)] = 0;
      }
    }
    return reward;
  }

  const VecEnv& env() const { return env_; }
  int ends() const { return ends_; }

 private:
  static EnvConfig SingleStepConfig(EnvConfig config) {
    config.action_repeat = 1;
    return config;
  }
  static EnvConfig CleanConfig(const EnvConfig& config) {
    EnvConfig clean = SingleStepConfig(config);
    clean.observation_noise = 0;
    return clean;
  }

  Eigen::Vector4d QuaternionOf(int i) const {
    Eigen::Vector4d q;
    for (int k = 0; k < 4; ++k) q[k] = env_.StateOf(i, kQ0 + k);
    return q;
  }
  EulerAngles AttitudeOf(int i) const { return EulerFromQuaternion(QuaternionOf(i)); }
  double SpeedOf(int i) const {
    Eigen::Vector3d over_ground;
    for (int k = 0; k < 3; ++k) over_ground[k] = env_.StateOf(i, kU + k);
    return (over_ground - BodyFromNed(QuaternionOf(i)) * Wind()).norm();
  }
  /// North, east, down; it must have one speed and one direction.
  Eigen::Vector3d Wind() const {
    const double from = config_.wind.from_deg.min / kDegPerRad;
    return -config_.wind.speed_fps.min * Eigen::Vector3d(std::cos(from), std::sin(from), 0);
  }
  std::array<double, 3> TargetOf(int i, const std::array<float, 3>& action) const {
    const auto clipped = [&action](int k) {
      return std::clamp(static_cast<double>(action[Index(k)]), -1.0, 1.0);
    };
    const EulerAngles attitude = AttitudeOf(i);
    return {attitude.pitch + 0.3 * clipped(0), attitude.yaw + 0.3 * clipped(1),
            SpeedOf(i) + 30 * clipped(2)};
  }
  std::array<double, 3> ErrorsOf(int i, const std::array<double, 3>& target) const {
    const EulerAngles attitude = AttitudeOf(i);
    return {target[0] - attitude.pitch, std::remainder(target[1] - attitude.yaw, 2 * M_PI),
            (target[2] - SpeedOf(i)) / kSpeedUnit};
  }

  EnvConfig config_;
  int count_;
  const Policy& low_level_;
  VecEnv env_, clean_;
  std::vector<float> memory_;
  std::vector<double> observation_sums_ = std::vector<double>(Index(count_ * kSize));  ///< sums
  std::vector<int> num_samples_ = std::vector<int>(Index(count_));
  int ends_ = 0;
};

/// Flies `config` both ways for ten policy steps, in which every aircraft begins two new episodes.
void ExpectTwoPlainLoops(const EnvConfig& config, int action_repeat) {
  // Errors in double against float32 in the hierarchy differ by 1e-7 at first.
  constexpr Tolerance kVelocity{0.02, "float32, amplified by seconds of flight"};
  constexpr Tolerance kRate{2e-4, "float32, amplified by seconds of flight"};
  constexpr Tolerance kPosition{0.05, "float32 of 2000 ft, amplified by seconds of flight"};
  constexpr Tolerance kReward{1e-3, "float32 of twenty steps of 10 km"};
  constexpr Tolerance kObservation{5e-4, "float32, amplified by seconds of flight"};
  constexpr int kCount = 40, kPolicySteps = 10;
  const TestPolicy low_level(action_repeat);
  VecEnv env(config, kCount, 3, 32, LowLevelPolicy(action_repeat));
  TwoLoops expected(config, kCount, 3, low_level);
  for (int policy_step = 0; policy_step < kPolicySteps; ++policy_step) {
    const std::vector<float> observation = expected.Observe();
    const Log log = Fly(&env, policy_step, 1);
    const std::vector<double> reward = expected.Step(policy_step);
    for (int i = 0; i < kCount; ++i) {
      for (int k = 0; k < kSize; ++k) {
        ASSERT_NEAR(log[Index(i)][Index(k)], observation[Index(i * kSize + k)], kObservation)
            << "aircraft " << i << ", policy step " << policy_step << ", element " << k;
      }
      ASSERT_NEAR(log[Index(i)][kSize], reward[Index(i)], kReward)
          << "aircraft " << i << ", policy step " << policy_step;
      const auto near = [&](int column, double tolerance) {
        ASSERT_NEAR(env.StateOf(i, column), expected.env().StateOf(i, column), tolerance)
            << "aircraft " << i << ", policy step " << policy_step << ", column " << column;
      };
      for (const int column : {kU, kV, kW}) near(column, kVelocity);
      for (const int column : {kP, kQ, kR, kQ0, kQx, kQy, kQz}) near(column, kRate);
      for (const int column : {kNorth, kEast, kDown}) near(column, kPosition);
    }
  }
  EXPECT_EQ(expected.ends(), 2 * kCount) << "new episodes were begun";
}

TEST(LowLevelFlight, EqualsTwoPlainLoops) {
  for (const double noise : {0.0, 0.02}) {
    for (const int action_repeat : {1, 4, 7}) {  // the last does not divide the policy step
      EnvConfig config = Config();
      config.observation_noise = noise;
      for (const bool averages : {false, true}) {
        config.high_level.averages_observations = averages;
        ExpectTwoPlainLoops(config, action_repeat);
      }
    }
  }
}

TEST(LowLevelFlight, EqualsTwoPlainLoopsInWind) {
  // Target speeds are relative to the air.
  EnvConfig config = Config();
  config.wind.speed_fps = {80, 80};
  config.wind.from_deg = {300, 300};
  for (const TrackingAxes axes : {TrackingAxes::kHeading, TrackingAxes::kPath}) {
    config.tracking.error_axes = axes;
    ExpectTwoPlainLoops(config, 4);
  }
}

TEST(LowLevelFlight, HighLevelPoliciesHaveThreeActions) {
  EXPECT_EQ(VecEnv(Config(), 1, 1, 32, LowLevelPolicy()).action_size(), 3);
  EXPECT_EQ(VecEnv(Config(), 1, 1, 32, LowLevelPolicy()).observation_size(), kSize);
  EXPECT_EQ(VecEnv(Config(), 1, 1).action_size(), 4);
}

TEST(LowLevelFlight, ChangesOfAllThreeActionsCostAndAreThoseOfPolicySteps) {
  constexpr Tolerance kFloat32{1e-4, "float32 rounding of rewards of some tens"};
  constexpr int kCount = 3;
  EnvConfig priced = Config();
  priced.reward.action_change = 1;
  VecEnv free(Config(), kCount, 1, 32, LowLevelPolicy());
  VecEnv env(priced, kCount, 1, 32, LowLevelPolicy());
  const double first = 0.5 * 0.5 + 0.25 * 0.25 + 1;  // the last is clipped
  for (const double expected : {first, 0.0}) {
    StepBuffers one(kCount, kHighLevelActionSize), other(kCount, kHighLevelActionSize);
    for (int i = 0; i < kCount; ++i) {
      const std::array<float, kHighLevelActionSize> action{0.5f, -0.25f, 2};
      std::copy(action.begin(), action.end(), one.action.begin() + i * kHighLevelActionSize);
    }
    other.action = one.action;
    free.Step(0, one.action.data(), one.output());
    env.Step(0, other.action.data(), other.output());
    for (int i = 0; i < kCount; ++i) {
      EXPECT_NEAR(one.reward[Index(i)] - other.reward[Index(i)], expected, kFloat32);
    }
  }
}

/// Returns all that is observed and rewarded.
Log ExpectSameForAnyTilesAndThreads(const EnvConfig& config) {
  VecEnv small(config, 300, 1, 32, LowLevelPolicy()), middle(config, 300, 1, 160, LowLevelPolicy()),
      large(config, 300, 1, 4096, LowLevelPolicy()), parallel(config, 300, 1, 32, LowLevelPolicy());
  const Log log = Fly(&small, 0, 12);
  EXPECT_EQ(log, Fly(&middle, 0, 12));
  EXPECT_EQ(log, Fly(&large, 0, 12));
  EXPECT_EQ(small.Snapshot(), large.Snapshot());
  WorkerPool pool(4);
  Log threaded(log.size());
  pool.ForEach(parallel.num_tiles(),
               [&](int tile, int) { FlyTile(&parallel, tile, 0, 12, &threaded); });
  EXPECT_EQ(log, threaded);
  EXPECT_EQ(small.Snapshot(), parallel.Snapshot());
  return log;
}

TEST(LowLevelFlight, DependsNeitherOnTilesNorOnThreads) {
  ExpectSameForAnyTilesAndThreads(Config());
}

TEST(LowLevelFlight, NorDoesThatOfDrawnPlantsWhoseSensorsAndActionsAreLate) {
  EnvConfig config = Config();
  config.plant = DrawnPlants();
  const Log drawn = ExpectSameForAnyTilesAndThreads(config);
  // Every aircraft flies otherwise than the nominal one.
  VecEnv nominal(Config(), 300, 1, 32, LowLevelPolicy());
  const Log usual = Fly(&nominal, 0, 12);
  for (std::size_t i = 0; i < usual.size(); ++i) EXPECT_NE(drawn[i], usual[i]) << i;
}

TEST(LowLevelFlight, SnapshotsHoldTheLowLevelPolicysState) {
  // Three policy steps into episodes of four.
  VecEnv env(Config(), 70, 1, 64, LowLevelPolicy());
  Fly(&env, 0, 3);
  const std::vector<std::uint32_t> snapshot = env.Snapshot();
  VecEnv without(Config(), 70, 1, 64);
  EXPECT_EQ(snapshot.size(), without.Snapshot().size() + 70 * 2);
  const Log expected = Fly(&env, 3, 6);
  VecEnv other(Config(), 70, 1, 32, LowLevelPolicy());
  Fly(&other, 0, 2);
  other.Restore(snapshot);
  EXPECT_EQ(other.Snapshot(), snapshot);
  EXPECT_EQ(Fly(&other, 3, 6), expected);
  EXPECT_THROW(without.Restore(snapshot), Error);
}

TEST(LowLevelFlight, SnapshotsHoldObservationSums) {
  EnvConfig config = Config();
  config.high_level.averages_observations = true;
  VecEnv env(config, 70, 1, 64, LowLevelPolicy());
  Fly(&env, 0, 3);
  const std::vector<std::uint32_t> snapshot = env.Snapshot();
  const Log expected = Fly(&env, 3, 6);
  VecEnv other(config, 70, 1, 32, LowLevelPolicy());
  Fly(&other, 0, 2);
  other.Restore(snapshot);
  EXPECT_EQ(Fly(&other, 3, 6), expected);
}

TEST(LowLevelFlight, AnActionThatIsNotFiniteEndsItsOwnEpisodeOnly) {
  for (const float poison : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
    for (int k = 0; k < kHighLevelActionSize; ++k) {
      VecEnv env(Config(), 40, 1, 64, LowLevelPolicy()),
          healthy(Config(), 40, 1, 64, LowLevelPolicy());
      StepBuffers buffers(40, kHighLevelActionSize), expected(40, kHighLevelActionSize);
      buffers.action[Index(7 * kHighLevelActionSize + k)] = poison;
      env.Step(0, buffers.action.data(), buffers.output());
      healthy.Step(0, expected.action.data(), expected.output());
      for (int i = 0; i < 40; ++i) {
        EXPECT_EQ(buffers.termination[Index(i)],
                  static_cast<int>(i == 7 ? Termination::kNonFinite : Termination::kNone));
        if (i != 7) {
          EXPECT_EQ(buffers.reward[Index(i)], expected.reward[Index(i)]);
        }
      }
      // And nothing of it stays.
      const Log log = Fly(&env, 0, 2);
      for (const float value : log[7]) EXPECT_TRUE(std::isfinite(value));
    }
  }
}

TEST(LowLevelFlight, RefusesALowLevelPolicyOfOtherSizes) {
  const auto message = [](const TestPolicy& low_level) -> std::string {
    try {
      VecEnv(Config(), 4, 1, 32, std::make_shared<const TestPolicy>(low_level));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(TestPolicy(1, 21, 4)).find("21 observations"), std::string::npos);
  EXPECT_NE(message(TestPolicy(1, 22, 3)).find("3 actions"), std::string::npos);
  EXPECT_EQ(message(TestPolicy(1)), "");
}

class SetTargetsTest : public testing::TestWithParam<simd::Target> {
 protected:
  /// The target (pitch, yaw, speed) of one aircraft that flies 800 ft/s ahead and 600 down, and is
  /// shown by its sensors as it was `before`, or as it is.
  std::array<float, 3> TargetOf(const EulerAngles& attitude, const std::array<float, 3>& action,
                                const std::optional<EulerAngles>& before = std::nullopt) {
    constexpr int kLast = 4;  // of a group that fills no vector
    TestTile flight(kLast + 1), shown(kLast + 1);
    FillFlight(attitude, &flight);
    FillFlight(before.value_or(attitude), &shown);
    std::vector<float> actions(3 * (kLast + 1), 0.0f);
    std::copy(action.begin(), action.end(), actions.begin() + 3 * kLast);
    LowLevelFlight low_level(config_, kLast + 1, LowLevelPolicy());
    LowLevelFlight::Scratch scratch;
    low_level.SetTargets(actions.data(), flight.tile(), shown.tile(), scratch);
    return {scratch.target[0][kLast], scratch.target[1][kLast], scratch.target[2][kLast]};
  }
  static void FillFlight(const EulerAngles& attitude, TestTile* flight) {
    const Eigen::Vector4d q = QuaternionFromEuler(attitude);
    for (int k = 0; k < 4; ++k) flight->Fill(kQ0 + k, static_cast<float>(q[k]));
    flight->Fill(kU, 800);
    flight->Fill(kW, 600);
  }
  void ExpectTarget(const std::array<float, 3>& target, double pitch, double yaw, double speed) {
    constexpr Tolerance kAngle{1e-6, "float32 rounding of radians"};
    constexpr Tolerance kSpeed{2e-4, "float32 rounding of 1000 ft/s"};
    EXPECT_NEAR(target[0], pitch, kAngle);
    EXPECT_NEAR(target[1], yaw, kAngle);
    EXPECT_NEAR(target[2], speed, kSpeed);
  }

  ScopedTarget target_{GetParam()};
  EnvConfig config_ = Config();
};

TEST_P(SetTargetsTest, TargetsAreChangesOfThePresentState) {
  ExpectTarget(TargetOf({0.7, 0.2, -1}, {0, 0, 0}), 0.2, -1, 1000);
  ExpectTarget(TargetOf({0.7, 0.2, -1}, {1, -0.5f, 0.1f}), 0.5, -1.15, 1003);
  ExpectTarget(TargetOf({-2, -0.2, 2}, {-0.5f, 1, -1}), -0.35, 2.3, 970);
}

TEST_P(SetTargetsTest, TheStateIsTheOneThatSensorsShow) {
  const EulerAngles before{0.7, 0.2, -1}, now{0.7, 0.3, -0.9};
  ExpectTarget(TargetOf(now, {1, -0.5f, 0.1f}, before), 0.5, -1.15, 1003);
}

TEST_P(SetTargetsTest, ActionsAreClipped) {
  ExpectTarget(TargetOf({0, 0.2, -1}, {5, -3, 100}), 0.5, -1.3, 1030);
}

TEST_P(SetTargetsTest, YawWrapsAndPitchStopsAtTheVertical) {
  ExpectTarget(TargetOf({0, 0, 3}, {0, 1, 0}), 0, 3.3 - 2 * M_PI, 1000);
  ExpectTarget(TargetOf({0, 1.4, 1}, {1, 0, 0}), M_PI / 2, 1, 1000);
  ExpectTarget(TargetOf({0, -1.5, 1}, {-1, 0, 0}), -M_PI / 2, 1, 1000);
}

TEST_P(SetTargetsTest, ChangesAreTheConfigurations) {
  config_.high_level.pitch_change_rad = 0.1;
  config_.high_level.yaw_change_rad = 1;
  config_.high_level.speed_change_fps = 200;
  ExpectTarget(TargetOf({0, 0.2, -1}, {1, 0.5f, -1}), 0.3, -0.5, 800);
}

INSTANTIATE_TEST_SUITE_P(Targets, SetTargetsTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& test) { return std::string(Name(test.param)); });

}  // namespace
}  // namespace skein
