// SPDX-License-Identifier: Apache-2.0
#include "train/policy/low_level_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "tests/envs/plant/drawn_plants.h"
#include "tests/envs/test_policy.h"
#include "tests/error_message.h"
#include "tests/file_bytes.h"
#include "tests/scratch_directory.h"
#include "tests/tolerance.h"
#include "tests/train/hierarchy_config.h"
#include "tests/train/libtorch.h"
#include "train/files/tensor_file.h"
#include "train/policy/autopilot_policy.h"
#include "train/policy/evaluate.h"
#include "train/policy/record_flights.h"
#include "train/ppo/trainer.h"

namespace skein {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::vector<float> FlyTwice(const Policy& policy) {
  constexpr int kCount = 9;
  std::vector<float> observation(static_cast<std::size_t>(kCount) * policy.observation_size());
  for (std::size_t i = 0; i < observation.size(); ++i) observation[i] = std::sin(0.7f * i);
  std::vector<float> state(static_cast<std::size_t>(kCount) * policy.state_size(), 0.0f);
  std::vector<float> action(static_cast<std::size_t>(kCount) * policy.action_size());
  policy.Act(kCount, observation.data(), state.data(), action.data());
  policy.Act(kCount, observation.data(), state.data(), action.data());
  action.insert(action.end(), state.begin(), state.end());
  return action;
}

RecurrentPolicy HighLevel(std::shared_ptr<const StoredPolicy> low_level) {
  return RecurrentPolicy::Untrained(SmallConfig().network, 22, 3, 3, 10, std::move(low_level));
}

class LowLevelPolicyFileTest : public testing::Test {
 protected:
  const ScratchDirectory scratch_;
  const std::string path_ = scratch_ / "high_level.skein";
};

TEST_F(LowLevelPolicyFileTest, AHighLevelPolicysFileHoldsItsLowLevelPolicy) {
  const RecurrentPolicy high_level = HighLevel(SmallLowLevelPolicy());
  high_level.Save(path_);
  const RecurrentPolicy loaded = RecurrentPolicy::Load(path_);
  EXPECT_EQ(loaded.action_size(), 3);
  ASSERT_NE(loaded.low_level(), nullptr);
  EXPECT_EQ(loaded.low_level()->action_repeat(), 4);
  EXPECT_EQ(FlyTwice(*loaded.low_level()), FlyTwice(*SmallLowLevelPolicy()));
  EXPECT_EQ(FlyTwice(loaded), FlyTwice(high_level));
  loaded.Save(scratch_ / "again");
  EXPECT_EQ(BytesOf(scratch_ / "again"), BytesOf(path_));
}

TEST_F(LowLevelPolicyFileTest, OtherPoliciesHaveNone) {
  SmallLowLevelPolicy()->Save(path_);
  EXPECT_EQ(RecurrentPolicy::Load(path_).low_level(), nullptr);
  for (const auto& [name, tensor] : TensorFile::Read(path_).tensors) {
    EXPECT_THAT(name, StartsWith("actor/"));
  }
}

TEST_F(LowLevelPolicyFileTest, DamageInTheLowLevelPolicyIsNamed) {
  HighLevel(SmallLowLevelPolicy()).Save(path_);
  TensorFile file = TensorFile::Read(path_);
  ASSERT_EQ(file.tensors.erase("low_level/actor/head.bias"), 1u);
  file.Write(path_);
  EXPECT_THAT(MessageOf([&] { RecurrentPolicy::Load(path_); }), HasSubstr("its low-level policy"));
}

TEST_F(LowLevelPolicyFileTest, AnAutopilotIsHeldByItsName) {
  EnvConfig env;
  env.control_interval_s = 0.01;
  const auto autopilot = std::make_shared<const AutopilotPolicy>("parallel", env);
  HighLevel(autopilot).Save(path_);
  const RecurrentPolicy loaded = RecurrentPolicy::Load(path_);
  ASSERT_NE(loaded.low_level(), nullptr);
  EXPECT_EQ(FlyTwice(*loaded.low_level()), FlyTwice(*autopilot));
  EXPECT_TRUE(IsSamePolicy(loaded.low_level().get(), autopilot.get()));
  const AutopilotPolicy slower("parallel", {}), other("aggressive", env);
  EXPECT_FALSE(IsSamePolicy(&slower, autopilot.get()));
  EXPECT_FALSE(IsSamePolicy(&other, autopilot.get()));
  EXPECT_FALSE(IsSamePolicy(SmallLowLevelPolicy().get(), autopilot.get()));
  TensorFile file = TensorFile::Read(path_);
  file.metadata["low_level.autopilot"] = "drunken";
  file.Write(path_);
  EXPECT_THAT(MessageOf([&] { RecurrentPolicy::Load(path_); }),
              AllOf(HasSubstr("its low-level policy"), HasSubstr("drunken")));
  file.metadata["low_level.autopilot"] = "parallel";
  for (const char* interval : {"0.02abc", "", "nan", "-0.02", "0"}) {
    file.metadata["low_level.control_interval_s"] = interval;
    file.Write(path_);
    EXPECT_THAT(MessageOf([&] { RecurrentPolicy::Load(path_); }), HasSubstr("its low-level policy"))
        << interval;
  }
  EXPECT_THROW(AutopilotPolicy("", {}), Error);
}

TEST_F(LowLevelPolicyFileTest, AHighLevelPolicyIsRefusedSinceItDoesNotFly) {
  TensorFile file;
  EXPECT_THROW(StoreLowLevelPolicy(HighLevel(SmallLowLevelPolicy()), file), Error);
  EXPECT_TRUE(file.tensors.empty());
}

TEST_F(LowLevelPolicyFileTest, LowLevelPoliciesAreTheSameByWhatTheyAre) {
  EXPECT_TRUE(IsSamePolicy(nullptr, nullptr));
  EXPECT_FALSE(IsSamePolicy(SmallLowLevelPolicy().get(), nullptr));
  EXPECT_TRUE(IsSamePolicy(SmallLowLevelPolicy().get(), SmallLowLevelPolicy().get()));
  EXPECT_FALSE(IsSamePolicy(SmallLowLevelPolicy(1).get(), SmallLowLevelPolicy(2).get()));
  const RecurrentPolicy slower = RecurrentPolicy::Untrained(SmallConfig().network, 22, 4, 11, 5);
  EXPECT_FALSE(IsSamePolicy(SmallLowLevelPolicy().get(), &slower));
}

TEST(RecurrentPolicyTest, ActsByTheMeanClipped) {
  NetworkConfig config = SmallConfig().network;
  config.tanh_mean = false;
  config.actor_head_scale = 5;
  const RecurrentPolicy policy = RecurrentPolicy::Untrained(config, 22, 4, 3);
  std::vector<float> observation(22 * 5), state(16 * 5), same_state(16 * 5), mean(20), action(20);
  for (std::size_t i = 0; i < observation.size(); ++i) observation[i] = std::sin(0.7f * i);
  policy.ActionMean(5, observation.data(), state.data(), mean.data());
  policy.Act(5, observation.data(), same_state.data(), action.data());
  EXPECT_EQ(state, same_state);
  int clipped = 0;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    EXPECT_EQ(action[i], std::clamp(mean[i], -1.0f, 1.0f));
    clipped += std::abs(mean[i]) > 1;
  }
  EXPECT_GT(clipped, 0);
}

class HighLevelTrainingTest : public LowLevelPolicyFileTest {};

TEST_F(HighLevelTrainingTest, EveryBitIsTheSameForAnyNumberOfThreads) {
  std::uint64_t first = 0;
  for (const int threads : {1, 2, 5}) {
    WorkerPool pool(threads);
    Trainer trainer(SmallHighLevelConfig(), pool);
    while (!trainer.finished()) trainer.Iterate();
    if (first == 0) first = trainer.Signature();
    EXPECT_EQ(trainer.Signature(), first) << threads << " threads";
  }
}

TEST_F(HighLevelTrainingTest, OverDrawnPlantsTooAndForAnyTiles) {
  TrainConfig config = SmallHighLevelConfig();
  config.env.plant = DrawnPlants();
  EvaluationOptions options;
  options.episodes = 300;  // more than a tile
  std::uint64_t first = 0;
  double first_return = 0;
  for (const auto& [threads, tile] : {std::pair{1, 32}, {3, 32}, {1, 96}, {5, 64}}) {
    WorkerPool pool(threads);
    config.learner.rollout_tile = tile;
    Trainer trainer(config, pool);
    while (!trainer.finished()) trainer.Iterate();
    const double mean_return =
        Evaluate(Agent::MeanOf(trainer.policy()), config.env, options, pool).return_mean;
    if (first == 0) {
      first = trainer.Signature();
      first_return = mean_return;
    }
    EXPECT_EQ(trainer.Signature(), first) << threads << " threads, tiles of " << tile;
    EXPECT_EQ(mean_return, first_return) << threads << " threads, tiles of " << tile;
  }
  WorkerPool pool(2);
  Trainer nominal(SmallHighLevelConfig(), pool);
  while (!nominal.finished()) nominal.Iterate();
  EXPECT_NE(nominal.Signature(), first) << "plants are drawn";
}

TEST_F(HighLevelTrainingTest, DependsOnTheLowLevelPolicy) {
  WorkerPool pool(2);
  TrainConfig other = SmallHighLevelConfig();
  other.low_level = SmallLowLevelPolicy(12);
  Trainer one(SmallHighLevelConfig(), pool), two(other, pool);
  EXPECT_EQ(one.Signature(), two.Signature()) << "equal at the start";
  one.Iterate();
  two.Iterate();
  EXPECT_NE(one.Signature(), two.Signature());
}

TEST_F(HighLevelTrainingTest, ComputesTheLowLevelPolicyOnItsOwnBackend) {
  SKEIN_SKIP_WITHOUT_LIBTORCH();
  WorkerPool pool(2);
  for (const Backend learner : {Backend::kFused, Backend::kLibTorch}) {
    std::vector<std::uint64_t> signatures;
    for (const Backend before : {Backend::kFused, Backend::kLibTorch}) {
      TrainConfig config = SmallHighLevelConfig();
      config.learner.backend = learner;
      config.low_level =
          std::make_shared<const RecurrentPolicy>(SmallLowLevelPolicy()->WithBackend(before));
      Trainer trainer(config, pool);
      trainer.Iterate();
      signatures.push_back(trainer.Signature());
    }
    EXPECT_EQ(signatures[0], signatures[1]) << Name(learner);
  }
}

TEST_F(HighLevelTrainingTest, ResumesBitExactly) {
  WorkerPool pool(2);
  Trainer whole(SmallHighLevelConfig(), pool);
  whole.Iterate();
  whole.Save(path_);
  Trainer resumed(SmallHighLevelConfig(), pool);
  resumed.Restore(path_);
  EXPECT_EQ(resumed.Signature(), whole.Signature());
  while (!whole.finished()) {
    whole.Iterate();
    resumed.Iterate();
  }
  EXPECT_EQ(resumed.Signature(), whole.Signature());
  whole.Save(scratch_ / "a");
  resumed.Save(scratch_ / "b");
  EXPECT_EQ(BytesOf(scratch_ / "a"), BytesOf(scratch_ / "b"));
}

TEST_F(HighLevelTrainingTest, RefusesACheckpointOverAnotherLowLevelPolicy) {
  WorkerPool pool(1);
  Trainer(SmallHighLevelConfig(), pool).Save(path_);
  TrainConfig other = SmallHighLevelConfig();
  other.low_level = SmallLowLevelPolicy(12);
  Trainer trainer(other, pool);
  const std::uint64_t before = trainer.Signature();
  EXPECT_THAT(MessageOf([&] { trainer.Restore(path_); }), HasSubstr("another low-level policy"));
  EXPECT_EQ(trainer.Signature(), before);
}

TEST_F(HighLevelTrainingTest, ACheckpointIsAWholeHighLevelPolicy) {
  WorkerPool pool(2);
  const TrainConfig config = SmallHighLevelConfig();
  Trainer trainer(config, pool);
  trainer.Iterate();
  trainer.Save(path_);
  const RecurrentPolicy loaded = RecurrentPolicy::Load(path_);
  EXPECT_EQ(loaded.task(), "tracking");
  EXPECT_EQ(loaded.action_repeat(), 10);
  EvaluationOptions options;
  options.episodes = 40;
  const EvaluationResult a = Evaluate(Agent::MeanOf(loaded), config.env, options, pool);
  const EvaluationResult b = Evaluate(Agent::MeanOf(trainer.policy()), config.env, options, pool);
  EXPECT_EQ(a.return_mean, b.return_mean);
  EXPECT_EQ(a.terminations, b.terminations);
}

TEST_F(HighLevelTrainingTest, RecordsActionsOfBothLevels) {
  WorkerPool pool(2);
  const TrainConfig config = SmallHighLevelConfig();
  const Agent high_level = Agent::SamplingFrom(HighLevel(SmallLowLevelPolicy()));
  EvaluationOptions options;
  options.episodes = 20;
  const EvaluationResult evaluated = Evaluate(high_level, config.env, options, pool);
  const auto flights = RecordFlights(high_level, config.env, options, options.episodes, pool);
  double return_sum = 0;
  for (const RecordedFlight& flight : flights) {
    for (std::size_t i = 0; i < flight.steps.size(); ++i) {
      const RecordedStep& step = flight.steps[i];
      ASSERT_EQ(step.action.size(), 3u);
      return_sum += step.reward;
      if (i == 0) continue;
      const RecordedStep& before = flight.steps[i - 1];
      EXPECT_EQ(step.action != before.action, i % 10 == 0) << i;
      // Within a policy step of ten steps the low-level policy acts at 0, 4 and 8.
      EXPECT_EQ(step.stick != before.stick, i % 10 % 4 == 0) << i;
    }
  }
  constexpr Tolerance kSumOrder{1e-2, "a hundred float32 rewards of ten, in another order"};
  EXPECT_NEAR(return_sum / options.episodes, evaluated.return_mean, kSumOrder);
}

/// Speed through still air.
double SpeedIn(const std::array<float, kNumRecordedColumns>& state) {
  return std::hypot(state[kU], state[kV], state[kW]);
}

TEST_F(HighLevelTrainingTest, RecordsWhatIsAskedOfTheLowLevelPolicyByLateSensorsToo) {
  WorkerPool pool(2);
  TrainConfig config = SmallHighLevelConfig();
  constexpr int kDelay = 3;
  config.env.plant.observation_delay_steps = {kDelay, kDelay};
  const Agent high_level = Agent::SamplingFrom(HighLevel(SmallLowLevelPolicy()));
  EvaluationOptions options;
  options.episodes = 20;
  constexpr Tolerance kSpeed{1e-2, "float32, of some 800 ft/s"};
  int commands = 0;
  for (const RecordedFlight& flight :
       RecordFlights(high_level, config.env, options, options.episodes, pool)) {
    const auto state_at = [&flight](std::size_t steps) {
      return steps == 0 ? flight.initial_state : flight.steps[steps - 1].state;
    };
    for (std::size_t i = 0; i < flight.steps.size(); ++i) {
      const RecordedStep& step = flight.steps[i];
      ASSERT_EQ(step.command.size(), 3u);
      if (i % 10 != 0) {
        EXPECT_EQ(step.command, flight.steps[i - 1].command) << i;
        continue;
      }
      const double seen = SpeedIn(state_at(i < kDelay ? 0 : i - kDelay));
      EXPECT_NEAR(step.command[2], seen + config.env.high_level.speed_change_fps * step.action[2],
                  kSpeed);
      ++commands;
    }
  }
  EXPECT_GT(commands, 20);
}

}  // namespace
}  // namespace skein
