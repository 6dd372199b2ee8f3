// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/reward_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "tests/error_message.h"

namespace skein {
namespace {

using ::testing::EndsWith;

/// What is said of a reward of 1e20 where `change` has set the weights.
std::string Blamed(const std::function<void(EnvConfig*)>& change) {
  TrainConfig config;
  change(&config.env);
  return MessageOf([&] { RequireUsableRewards(config, {1, 1e20F}, {0, 0}); });
}

TEST(RewardCheck, RewardsThatSumAndSquareAreUsable) {
  EXPECT_EQ(MessageOf([] { RequireUsableRewards({}, {0, -1e15F, 1e15F}, {0, 0, 0}); }), "");
  const float infinite = std::numeric_limits<float>::infinity();
  for (const float bad : {-1.1e15F, infinite, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_NE(MessageOf([&] { RequireUsableRewards({}, {0, bad}, {0, 0}); }), "") << bad;
  }
}

TEST(RewardCheck, BlamesNoRewardForTheValueOfACriticThatExploded) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(MessageOf([&] { RequireUsableRewards({}, {0, none}, {0, none}); }), "");
  EXPECT_NE(MessageOf([&] { RequireUsableRewards({}, {none, none}, {0, none}); }), "");
}

TEST(RewardCheck, NamesTheWeightThatIsLargestInMagnitude) {
  EXPECT_THAT(Blamed([](EnvConfig* env) { env->reward.roll_rate = 1e30; }),
              EndsWith("is env.reward.roll_rate = 1e+30"));
  EXPECT_THAT(Blamed([](EnvConfig* env) { env->termination.failure_reward = -1e20; }),
              EndsWith("is env.termination.failure_reward = -1e+20"));
  EXPECT_THAT(Blamed([](EnvConfig* env) {
                env->termination.failure_reward = -1e20;
                env->termination.success_reward = 1e21;
              }),
              EndsWith("is env.termination.success_reward = 1e+21"));
  EXPECT_THAT(Blamed([](EnvConfig* env) {
                env->reward.near_sharpness = 1e6;  // no weight
                env->termination.failure_reward = -1e4;
                env->termination.success_reward = 0;
              }),
              EndsWith("is env.termination.failure_reward = -10000"));
}

TEST(RewardCheck, NamesWhatMultipliesTheWeightsIfItIsNotOne) {
  EXPECT_THAT(Blamed([](EnvConfig* env) { env->reward_scale = 1e18; }),
              EndsWith("; env.reward_scale = 1e+18"));
}

TEST(RewardCheck, NamesTheTermOfATaskFile) {
  EXPECT_THAT(Blamed([](EnvConfig* env) {
                auto task = std::make_shared<TermTaskConfig>();
                task->rewards.resize(3);
                task->rewards[1].weight = -1e25;
                env->term_task = task;
              }),
              EndsWith("is the task file's [[reward]] number 2: weight = -1e+25"));
}

}  // namespace
}  // namespace skein
