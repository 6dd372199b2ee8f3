#include "train/policy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "simd/error.h"
#include "tests/scratch_directory.h"
#include "tests/train/small_config.h"
#include "train/evaluate.h"
#include "train/tensor_file.h"
#include "train/trainer.h"

namespace skein {
namespace {

std::vector<float> Decide(const Policy& policy, int count) {
  std::vector<float> observation(static_cast<std::size_t>(count) * policy.observation_size());
  for (std::size_t i = 0; i < observation.size(); ++i) observation[i] = std::sin(0.7f * i);
  std::vector<float> state(static_cast<std::size_t>(count) * policy.state_size(), 0.0f);
  std::vector<float> mean(static_cast<std::size_t>(count) * policy.action_size());
  policy.Act(count, observation.data(), state.data(), mean.data());
  policy.Act(count, observation.data(), state.data(), mean.data());
  mean.insert(mean.end(), state.begin(), state.end());
  return mean;
}

class PolicyTest : public testing::Test {
 protected:
  const ScratchDirectory scratch_;
  const std::string path_ = scratch_ / "policy.skein";
};

TEST_F(PolicyTest, FileGivesTheSameDecisions) {
  const Policy policy = Policy::Untrained(SmallConfig().network, 22, 4, 3, 5);
  policy.Save(path_);
  const Policy loaded = Policy::Load(path_);
  EXPECT_EQ(loaded.observation_size(), 22);
  EXPECT_EQ(loaded.action_size(), 4);
  EXPECT_EQ(loaded.state_size(), 16);
  EXPECT_EQ(loaded.action_repeat(), 5);
  EXPECT_EQ(Decide(loaded, 9), Decide(policy, 9));
}

TEST_F(PolicyTest, FilesKeepEveryShape) {
  NetworkConfig config;
  config.hidden_size = 33;
  config.gru_size = 10;
  for (const int depth : {0, 1, 3}) {
    for (const Activation activation : {Activation::kRelu, Activation::kSilu}) {
      config.hidden_layers = depth;
      config.gru_layers = depth + 1;
      config.activation = activation;
      const Policy policy = Policy::Untrained(config, 22, 4, 3);
      policy.Save(path_);
      const Policy loaded = Policy::Load(path_);
      EXPECT_EQ(loaded.config().hidden_layers, depth);
      EXPECT_EQ(loaded.config().activation, activation);
      EXPECT_EQ(loaded.state_size(), 10 * (depth + 1));
      EXPECT_EQ(Decide(loaded, 5), Decide(policy, 5));
    }
  }
}

TEST_F(PolicyTest, ReadsFilesFromBeforeNetworksHadDepths) {
  const Policy policy = Policy::Untrained(SmallConfig().network, 22, 4, 3);
  policy.Save(path_);
  TensorFile file = TensorFile::Read(path_);
  for (const char* key : {"policy.hidden_layers", "policy.gru_layers", "policy.activation"}) {
    EXPECT_EQ(file.metadata.erase(key), 1u) << key;
  }
  file.Write(path_);
  EXPECT_EQ(Decide(Policy::Load(path_), 5), Decide(policy, 5));
}

TEST_F(PolicyTest, BackendsDecideAlike) {
  const Policy fused = Policy::Untrained(SmallConfig().network, 22, 4, 3);
  const Policy libtorch = fused.WithBackend(Backend::kLibTorch);
  EXPECT_EQ(fused.backend().backend, Backend::kFused);
  EXPECT_EQ(libtorch.backend().backend, Backend::kLibTorch);
  const std::vector<float> a = Decide(fused, 9), b = Decide(libtorch, 9);
  // A few float32 roundings of values of order one.
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-5);
}

TEST_F(PolicyTest, ACheckpointIsAPolicyToo) {
  WorkerPool pool(1);
  Trainer trainer(SmallConfig(), pool);
  trainer.Iterate();
  trainer.Save(path_);
  EXPECT_EQ(Decide(Policy::Load(path_), 5), Decide(trainer.policy(), 5));
}

TEST_F(PolicyTest, UntrainedIsWhatTrainingBeginsWith) {
  const TrainConfig config = SmallConfig();
  WorkerPool pool(1);
  EXPECT_EQ(Decide(Policy::Untrained(config.network, 22, 4, config.seed), 3),
            Decide(Trainer(config, pool).policy(), 3));
}

TEST_F(PolicyTest, SeveralThreadsDecideAtOnce) {
  const Policy policy = Policy::Untrained(SmallConfig().network, 22, 4, 3);
  const std::vector<float> expected = Decide(policy, 40);
  std::vector<std::vector<float>> results(4);
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&] { result = Decide(policy, 40); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& result : results) EXPECT_EQ(result, expected);
}

TEST_F(PolicyTest, RefusesFilesThatAreNoPolicy) {
  const auto refused = [&](const char* key, const char* value) {
    Policy::Untrained(SmallConfig().network, 22, 4, 3).Save(path_);
    TensorFile file = TensorFile::Read(path_);
    if (value == nullptr) {
      file.metadata.erase(key);
    } else {
      file.metadata[key] = value;
    }
    file.Write(path_);
    EXPECT_THROW(Policy::Load(path_), Error) << key;
  };
  refused("policy.format", "skein-policy-99");
  refused("policy.format", nullptr);
  refused("policy.hidden_size", "64");
  refused("policy.hidden_size", "33");
  refused("policy.hidden_size", "1e9");
  refused("policy.gru_size", "-16");
  refused("policy.gru_size", "nan");
  refused("policy.hidden_layers", "9");
  refused("policy.hidden_layers", "3");
  refused("policy.gru_layers", "0");
  refused("policy.activation", "RELU");
  refused("policy.action_size", "");
  refused("policy.action_repeat", "0");
  Policy::Untrained(SmallConfig().network, 22, 4, 3).Save(path_);
  TensorFile file = TensorFile::Read(path_);
  file.tensors["actor/head.bias"].bytes.assign(16, 0xff);  // not-a-number
  file.Write(path_);
  EXPECT_THROW(Policy::Load(path_), Error);
}

TEST(EvaluateTest, CountsOneEpisodePerAircraftWhateverTheThreads) {
  const TrainConfig config = SmallConfig();
  const Policy policy = Policy::Untrained(config.network, 22, 4, 3);
  EvaluationOptions options;
  options.episodes = 150;
  for (const bool deterministic : {true, false}) {
    options.deterministic = deterministic;
    WorkerPool one(1), three(3);
    const EvaluationResult a = Evaluate(policy, config.env, options, one);
    const EvaluationResult b = Evaluate(policy, config.env, options, three);
    int total = 0;
    for (const int count : a.terminations) total += count;
    EXPECT_EQ(total, 150);
    EXPECT_EQ(a.terminations[0], 0);
    EXPECT_EQ(a.terminations, b.terminations);
    EXPECT_EQ(a.return_mean, b.return_mean);
    // Nobody reaches a target before step 300, and these episodes end at 100.
    EXPECT_EQ(a.success_rate, 0);
    EXPECT_TRUE(std::isnan(a.time_to_target_mean_s));
  }
}

TEST(EvaluateTest, TimeToTargetIsTheClockOfTheEpisodesThatReachIt) {
  EnvConfig env;
  env.action_repeat = 5;
  // Targets that every state within the limits has reached: success is a matter of the clock.
  env.heading.altitude_tolerance_ft = 1e6;
  env.heading.yaw_tolerance_deg = 180;
  env.heading.speed_tolerance_fps = 1e6;
  env.heading.earliest_success_step = 100;
  EvaluationOptions options;
  options.episodes = 40;
  WorkerPool pool(1);
  const Policy policy = Policy::Untrained(SmallConfig().network, 22, 4, 3);
  const EvaluationResult result = Evaluate(policy, env, options, pool);
  EXPECT_EQ(result.success_rate, 1);
  EXPECT_EQ(result.terminations[static_cast<int>(Termination::kResetTarget)], 40);
  EXPECT_DOUBLE_EQ(result.time_to_target_mean_s, 100 * env.control_interval_s);
}

TEST(EvaluateTest, RefusesAPolicyOfAnotherTask) {
  WorkerPool pool(1);
  const Policy policy = Policy::Untrained(SmallConfig().network, 20, 4, 3);
  EXPECT_THROW(Evaluate(policy, SmallConfig().env, {}, pool), Error);
}

}  // namespace
}  // namespace skein
