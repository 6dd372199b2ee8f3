// SPDX-License-Identifier: Apache-2.0
#include "train/policy/policy_environment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>

#include "envs/autopilot/autopilot.h"
#include "tests/error_message.h"
#include "tests/scratch_directory.h"
#include "tests/train/hierarchy_config.h"
#include "train/files/tensor_file.h"
#include "train/policy/autopilot_policy.h"
#include "train/policy/evaluate.h"
#include "train/ppo/trainer.h"

namespace skein {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

using Change = std::function<void(EnvConfig&)>;

class PolicyEnvironmentTest : public testing::Test {
 protected:
  /// The policy of a training in `config`, by way of its file.
  RecurrentPolicy Trained(const TrainConfig& config) const {
    WorkerPool pool(1);
    Trainer(config, pool).policy().Save(path_);
    return RecurrentPolicy::Load(path_);
  }
  /// Of `policy` flown in `env` with `change`.
  static std::string ErrorOf(const RecurrentPolicy& policy, EnvConfig env, const Change& change) {
    change(env);
    EvaluationOptions options;
    options.episodes = 1;
    return MessageOf([&] { MakeEvaluationEnv(Agent::MeanOf(policy), env, options); });
  }

  const ScratchDirectory scratch_;
  const std::string path_ = scratch_ / "policy.skein";
};

const std::pair<const char*, Change> kChangesOfMeaning[] = {
    {"task", [](EnvConfig& env) { env.task = "control"; }},
    {"aircraft",
     [](EnvConfig& env) {
       env.aircraft = "aerosonde";
       env.initial = {{1500, 1500}, {80, 80}, false};
       env.termination.min_altitude_ft = 0;
     }},
    {"control_interval_s", [](EnvConfig& env) { env.control_interval_s = 0.01; }},
    {"flight_control", [](EnvConfig& env) { env.flight_control = FlightControlMode::kDirect; }},
};

const std::pair<const char*, Change> kChangesOfTheHighLevel[] = {
    {"tracking.error_axes", [](EnvConfig& env) { env.tracking.error_axes = TrackingAxes::kEarth; }},
    {"high_level.averages_observations",
     [](EnvConfig& env) { env.high_level.averages_observations = true; }},
    {"high_level.pitch_change_rad", [](EnvConfig& env) { env.high_level.pitch_change_rad = 0.2; }},
    {"high_level.yaw_change_rad", [](EnvConfig& env) { env.high_level.yaw_change_rad = 0.2; }},
    {"high_level.speed_change_fps", [](EnvConfig& env) { env.high_level.speed_change_fps = 40; }},
};

TEST_F(PolicyEnvironmentTest, PoliciesFlyOnlyWhatTheyWereMadeFor) {
  const TrainConfig config = SmallConfig();
  const RecurrentPolicy policy = Trained(config);
  for (const auto& [key, change] : kChangesOfMeaning) {
    EXPECT_THAT(ErrorOf(policy, config.env, change),
                StartsWith("the policy was made with env." + std::string(key) + " = "));
  }
  EXPECT_EQ(ErrorOf(policy, config.env,
                    [](EnvConfig& env) {
                      env.action_repeat = 1;
                      env.observation_noise = 0.1;
                      env.heading.yaw_change_rad = 1;
                      env.high_level.yaw_change_rad = 1;  // of no high-level policy
                    }),
            "");
}

TEST_F(PolicyEnvironmentTest, HighLevelPoliciesFlyOnlyWhatTheyWereMadeFor) {
  const TrainConfig config = SmallHighLevelConfig();
  const RecurrentPolicy high_level = Trained(config);
  for (const auto& [key, change] : kChangesOfTheHighLevel) {
    EXPECT_THAT(ErrorOf(high_level, config.env, change),
                StartsWith("the policy was made with env." + std::string(key) + " = "));
  }
  EXPECT_EQ(ErrorOf(high_level, config.env, [](EnvConfig& env) { env.tracking.azimuth_deg = 9; }),
            "");
}

TEST_F(PolicyEnvironmentTest, SoDoTheLowLevelPoliciesBelowThem) {
  TrainConfig config = SmallConfig();
  config.env.task = "control";
  config.env.control_interval_s = 0.01;
  const auto low_level = std::make_shared<const RecurrentPolicy>(Trained(config));
  const RecurrentPolicy high_level =
      RecurrentPolicy::Untrained(config.network, 22, 3, 3, /*action_repeat=*/10, low_level);
  EnvConfig env = SmallHighLevelConfig().env;
  EXPECT_THAT(
      ErrorOf(high_level, env, [](EnvConfig&) {}),
      StartsWith("the policy's low-level policy was made with env.control_interval_s = 0.01"));
  EXPECT_EQ(ErrorOf(high_level, env, [](EnvConfig& flown) { flown.control_interval_s = 0.01; }),
            "");

  TrainConfig training = SmallHighLevelConfig();
  training.low_level = low_level;
  EXPECT_THAT(MessageOf([&] { Trained(training); }),
              StartsWith("the low-level policy was made with env.control_interval_s = 0.01"));
  training.low_level = std::make_shared<const RecurrentPolicy>(Trained(SmallConfig()));
  EXPECT_THAT(MessageOf([&] { Trained(training); }),
              StartsWith("the low-level policy was made with env.task = heading"));
}

TEST_F(PolicyEnvironmentTest, AnAutopilotFromAFileFliesOnlyWhatItHasGainsFor) {
  const TrainConfig config = SmallHighLevelConfig();
  RecurrentPolicy::Untrained(config.network, 22, 3, 3, /*action_repeat=*/10,
                             std::make_shared<const AutopilotPolicy>("parallel", config.env))
      .Save(path_);
  const RecurrentPolicy high_level = RecurrentPolicy::Load(path_);
  EXPECT_EQ(ErrorOf(high_level, config.env, [](EnvConfig&) {}), "");
  for (const auto& [key, change] : kChangesOfMeaning) {
    if (std::string(key) == "task") continue;
    const std::string error = ErrorOf(high_level, config.env, change);
    EXPECT_THAT(error, StartsWith("the policy's low-level policy"));
    EXPECT_THAT(error, HasSubstr("env." + std::string(key) + " = "));
  }
}

TEST_F(PolicyEnvironmentTest, WhatAFileDoesNotSayIsNotChecked) {
  const TrainConfig config = SmallConfig();
  Trained(config);
  TensorFile file = TensorFile::Read(path_);
  ASSERT_EQ(file.metadata.erase("policy.task"), 1u);
  for (const char* key : {"aircraft", "control_interval_s", "flight_control"}) {
    ASSERT_EQ(file.metadata.erase("policy.env." + std::string(key)), 1u) << key;
  }
  file.Write(path_);
  const RecurrentPolicy untrained = RecurrentPolicy::Untrained(config.network, 22, 4, 3);
  for (const RecurrentPolicy& policy : {RecurrentPolicy::Load(path_), untrained}) {
    for (const auto& [key, change] : kChangesOfMeaning) {
      EXPECT_EQ(ErrorOf(policy, config.env, change), "") << key;
    }
  }
}

TEST_F(PolicyEnvironmentTest, AxesAndRateAreThePolicysOwn) {
  TrainConfig config = SmallHighLevelConfig();
  config.env.tracking.error_axes = TrackingAxes::kPath;
  config.env.high_level.averages_observations = true;
  const RecurrentPolicy policy = Trained(config);
  EnvConfig episodes = config.env;
  episodes.tracking.error_axes = TrackingAxes::kEarth;
  episodes.tracking.azimuth_deg = 77;
  episodes.action_repeat = 3;
  const EnvConfig own = policy.EnvironmentFor(episodes);
  EXPECT_EQ(own.tracking.error_axes, TrackingAxes::kPath);
  EXPECT_TRUE(own.high_level.averages_observations);
  EXPECT_EQ(own.action_repeat, config.env.action_repeat);
  EXPECT_EQ(own.tracking.azimuth_deg, 77) << "the episodes are not";

  const auto autopilot = MakeAutopilot(EnvConfig{}, AutopilotVariant::kTraditional);
  EXPECT_EQ(autopilot->EnvironmentFor(episodes).tracking.error_axes, kAutopilotErrorAxes);
  EXPECT_EQ(autopilot->EnvironmentFor(episodes).action_repeat, 1);
}

TEST_F(PolicyEnvironmentTest, CheckpointsSayItToo) {
  WorkerPool pool(1);
  const TrainConfig config = SmallHighLevelConfig();
  Trainer trainer(config, pool);
  trainer.Save(path_);
  const TensorFile checkpoint = TensorFile::Read(path_);
  trainer.policy().Save(path_);
  const TensorFile policy = TensorFile::Read(path_);
  EXPECT_GT(policy.metadata.count("policy.env.tracking.error_axes"), 0u);
  for (const auto& [key, value] : policy.metadata) {
    if (key == "checksum") continue;
    ASSERT_EQ(checkpoint.metadata.count(key), 1u) << key;
    EXPECT_EQ(checkpoint.metadata.at(key), value);
  }
}

/// `file` as the version wrote it that called a high-level policy a planner.
TensorFile AsOfPlanners(TensorFile file) {
  const std::string now = "env.high_level.", then = "env.planner.";
  std::map<std::string, std::string> metadata;
  for (const auto& [key, value] : file.metadata) {
    const auto at = key.find(now);
    metadata[at == std::string::npos ? key
                                     : key.substr(0, at) + then + key.substr(at + now.size())] =
        value;
  }
  file.metadata = metadata;
  return file;
}

TEST_F(PolicyEnvironmentTest, FormerNamesInOlderFilesAreUnderstood) {
  TrainConfig config = SmallHighLevelConfig();
  config.env.high_level.averages_observations = true;
  config.env.high_level.yaw_change_rad = 0.25;
  WorkerPool pool(1);
  Trainer trainer(config, pool);
  trainer.Save(path_);
  const TensorFile older = AsOfPlanners(TensorFile::Read(path_));
  EXPECT_EQ(older.metadata.count("config.env.planner.yaw_change_rad"), 1u);
  older.Write(path_);
  EXPECT_NO_THROW(trainer.Restore(path_));
  const RecurrentPolicy policy = RecurrentPolicy::Load(path_);
  EXPECT_TRUE(policy.EnvironmentFor(EnvConfig{}).high_level.averages_observations);
  EXPECT_THAT(
      ErrorOf(policy, config.env, [](EnvConfig& env) { env.high_level.yaw_change_rad = 1; }),
      HasSubstr("env.high_level.yaw_change_rad = 0.25"));
}

}  // namespace
}  // namespace skein
