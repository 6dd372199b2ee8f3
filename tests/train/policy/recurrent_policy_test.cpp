// SPDX-License-Identifier: Apache-2.0
#include "train/policy/recurrent_policy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "base/error.h"
#include "tests/error_message.h"
#include "tests/scratch_directory.h"
#include "tests/tolerance.h"
#include "tests/train/hierarchy_config.h"
#include "tests/train/libtorch.h"
#include "tests/train/small_config.h"
#include "tests/train/version_0_1.h"
#include "train/files/tensor_file.h"
#include "train/policy/low_level_file.h"
#include "train/policy/policy_parameters.h"
#include "train/ppo/trainer.h"

namespace skein {
namespace {

using ::testing::StartsWith;

std::vector<float> ActionsOf(const RecurrentPolicy& policy, int count) {
  std::vector<float> observation(static_cast<std::size_t>(count) * policy.observation_size());
  for (std::size_t i = 0; i < observation.size(); ++i) observation[i] = std::sin(0.7f * i);
  std::vector<float> state(static_cast<std::size_t>(count) * policy.state_size(), 0.0f);
  std::vector<float> mean(static_cast<std::size_t>(count) * policy.action_size());
  policy.ActionMean(count, observation.data(), state.data(), mean.data());
  policy.ActionMean(count, observation.data(), state.data(), mean.data());
  mean.insert(mean.end(), state.begin(), state.end());
  return mean;
}

class PolicyTest : public testing::Test {
 protected:
  const ScratchDirectory scratch_;
  const std::string path_ = scratch_ / "policy.skein";
};

TEST_F(PolicyTest, FileGivesTheSamePolicySteps) {
  const RecurrentPolicy policy = RecurrentPolicy::Untrained(SmallConfig().network, 22, 4, 3, 5);
  policy.Save(path_);
  const RecurrentPolicy loaded = RecurrentPolicy::Load(path_);
  EXPECT_EQ(loaded.observation_size(), 22);
  EXPECT_EQ(loaded.action_size(), 4);
  EXPECT_EQ(loaded.state_size(), 16);
  EXPECT_EQ(loaded.action_repeat(), 5);
  EXPECT_EQ(ActionsOf(loaded, 9), ActionsOf(policy, 9));
}

/// Saves networks of several depths to `path` and reads them again.
void ExpectFilesKeepDepths(Activation activation, const std::string& path) {
  NetworkConfig config;
  config.hidden_size = 33;
  config.gru_size = 10;
  config.activation = activation;
  for (const int depth : {0, 1, 3}) {
    config.hidden_layers = depth;
    config.gru_layers = depth + 1;
    const RecurrentPolicy policy = RecurrentPolicy::Untrained(config, 22, 4, 3);
    policy.Save(path);
    const RecurrentPolicy loaded = RecurrentPolicy::Load(path);
    EXPECT_EQ(loaded.config().hidden_layers, depth);
    EXPECT_EQ(loaded.config().activation, activation);
    EXPECT_EQ(loaded.state_size(), 10 * (depth + 1));
    EXPECT_EQ(ActionsOf(loaded, 5), ActionsOf(policy, 5));
  }
}

TEST_F(PolicyTest, FilesKeepEveryShape) { ExpectFilesKeepDepths(Activation::kRelu, path_); }

TEST_F(PolicyTest, FilesKeepEveryShapeOfOtherActivations) {
  SKEIN_SKIP_WITHOUT_LIBTORCH();
  ExpectFilesKeepDepths(Activation::kSilu, path_);
}

TEST_F(PolicyTest, ReadsFilesFromBeforeNetworksHadDepths) {
  const RecurrentPolicy policy = RecurrentPolicy::Untrained(SmallConfig().network, 22, 4, 3);
  policy.Save(path_);
  TensorFile file = TensorFile::Read(path_);
  for (const char* key : {"policy.hidden_layers", "policy.gru_layers", "policy.activation"}) {
    EXPECT_EQ(file.metadata.erase(key), 1u) << key;
  }
  file.Write(path_);
  EXPECT_EQ(ActionsOf(RecurrentPolicy::Load(path_), 5), ActionsOf(policy, 5));
}

TEST_F(PolicyTest, FilesOfVersion01AreThePoliciesThatTheyWere) {
  WorkerPool pool(1);
  const RecurrentPolicy policy = Trainer(SmallHighLevelConfig(), pool).policy();
  policy.Save(path_);
  const TensorFile old = AsOfVersion01(TensorFile::Read(path_));
  EXPECT_EQ(old.tensors.count("controller/actor/head.bias"), 1u);
  EXPECT_EQ(old.metadata.count("controller.policy.format"), 1u);
  EXPECT_EQ(old.metadata.count("policy.env.planner.yaw_change_rad"), 1u);
  old.Write(path_);
  const RecurrentPolicy loaded = RecurrentPolicy::Load(path_);
  ASSERT_NE(loaded.low_level(), nullptr);
  EXPECT_TRUE(IsSamePolicy(loaded.low_level().get(), SmallLowLevelPolicy().get()));
  EXPECT_EQ(loaded.parameters()->environment, policy.parameters()->environment);
  EXPECT_TRUE(IsSamePolicy(&loaded, &policy));
}

constexpr Tolerance kFloat32{1e-5, "a few float32 roundings of values of order one"};

TEST_F(PolicyTest, BackendsActAlike) {
  SKEIN_SKIP_WITHOUT_LIBTORCH();
  const RecurrentPolicy fused = RecurrentPolicy::Untrained(SmallConfig().network, 22, 4, 3);
  const RecurrentPolicy libtorch = fused.WithBackend(Backend::kLibTorch);
  EXPECT_EQ(fused.backend().backend, Backend::kFused);
  EXPECT_EQ(libtorch.backend().backend, Backend::kLibTorch);
  const std::vector<float> a = ActionsOf(fused, 9), b = ActionsOf(libtorch, 9);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], kFloat32);
}

TEST_F(PolicyTest, ALowLevelPolicyIsComputedAsItsHighLevelIs) {
  SKEIN_SKIP_WITHOUT_LIBTORCH();
  const auto fused = std::make_shared<const RecurrentPolicy>(
      RecurrentPolicy::Untrained(SmallConfig().network, 22, 4, 3));
  const RecurrentPolicy high_level =
      RecurrentPolicy::Untrained(SmallConfig().network, 22, 3, 3, 10, fused);
  EXPECT_TRUE(IsSamePolicy(high_level.low_level().get(), fused.get()));
  for (const Backend backend : {Backend::kLibTorch, Backend::kFused}) {
    const RecurrentPolicy computed = high_level.WithBackend(backend);
    const auto low_level = std::dynamic_pointer_cast<const RecurrentPolicy>(computed.low_level());
    ASSERT_NE(low_level, nullptr);
    EXPECT_EQ(low_level->backend().backend, backend);
    const std::vector<float> a = ActionsOf(*fused, 9), b = ActionsOf(*low_level, 9);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], kFloat32);
  }
}

TEST_F(PolicyTest, ACheckpointIsAPolicyToo) {
  WorkerPool pool(1);
  Trainer trainer(SmallConfig(), pool);
  trainer.Iterate();
  trainer.Save(path_);
  EXPECT_EQ(ActionsOf(RecurrentPolicy::Load(path_), 5), ActionsOf(trainer.policy(), 5));
}

TEST_F(PolicyTest, UntrainedIsWhatTrainingBeginsWith) {
  const TrainConfig config = SmallConfig();
  WorkerPool pool(1);
  EXPECT_EQ(ActionsOf(RecurrentPolicy::Untrained(config.network, 22, 4, config.seed), 3),
            ActionsOf(Trainer(config, pool).policy(), 3));
}

TEST_F(PolicyTest, SeveralThreadsActAtOnce) {
  const RecurrentPolicy policy = RecurrentPolicy::Untrained(SmallConfig().network, 22, 4, 3);
  const std::vector<float> expected = ActionsOf(policy, 40);
  std::vector<std::vector<float>> results(4);
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&] { result = ActionsOf(policy, 40); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& result : results) EXPECT_EQ(result, expected);
}

TEST_F(PolicyTest, RefusesFilesThatAreNoPolicy) {
  const auto refused = [&](const char* key, const char* value) {
    RecurrentPolicy::Untrained(SmallConfig().network, 22, 4, 3).Save(path_);
    TensorFile file = TensorFile::Read(path_);
    if (value == nullptr) {
      file.metadata.erase(key);
    } else {
      file.metadata[key] = value;
    }
    file.Write(path_);
    EXPECT_THAT(MessageOf([&] { RecurrentPolicy::Load(path_); }), StartsWith(path_ + ": "))
        << key << " " << (value == nullptr ? "" : value);
  };
  refused("policy.format", "skein-policy-99");
  refused("policy.format", nullptr);
  refused("policy.hidden_size", "64");
  refused("policy.hidden_size", "33");
  refused("policy.hidden_size", "1025");
  refused("policy.hidden_size", "1e9");
  refused("policy.gru_size", "-16");
  refused("policy.gru_size", "nan");
  refused("policy.hidden_layers", "9");
  refused("policy.hidden_layers", "3");
  refused("policy.gru_layers", "0");
  refused("policy.activation", "RELU");
  refused("policy.action_size", "");
  refused("policy.action_repeat", "0");
  refused("policy.action_repeat", "1001");
  RecurrentPolicy::Untrained(SmallConfig().network, 22, 4, 3).Save(path_);
  TensorFile file = TensorFile::Read(path_);
  file.tensors["actor/head.bias"].bytes.assign(16, 0xff);  // not-a-number
  file.Write(path_);
  EXPECT_THROW(RecurrentPolicy::Load(path_), Error);
}

}  // namespace
}  // namespace skein
