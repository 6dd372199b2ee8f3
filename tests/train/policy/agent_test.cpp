// SPDX-License-Identifier: Apache-2.0
#include "train/policy/agent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/tolerance.h"
#include "tests/train/small_config.h"

namespace skein {
namespace {

using Floats = std::vector<float>;

/// One policy step for `count` aircraft with the same observations.
Floats ActionsOf(const Agent& agent, const Agent::Turn& turn, int count) {
  const Floats observation(count * 22, 0.2f);
  Floats state(count * agent.state_size()), action(count * 4, 9);
  agent.Act(turn, count, observation.data(), state.data(), action.data());
  return action;
}

Floats Row(const Floats& rows, int i) { return {rows.begin() + 4 * i, rows.begin() + 4 * i + 4}; }

RecurrentPolicy SmallPolicy() {
  NetworkConfig config = SmallConfig().network;
  config.initial_log_std = -1;
  return RecurrentPolicy::Untrained(config, 22, 4, 3, 5);
}

TEST(AgentTest, ZeroActionsAreZero) {
  EXPECT_EQ(ActionsOf(Agent::Zero(), {}, 3), Floats(12, 0.0f));
}

TEST(AgentTest, RandomActionsAreUniformAndDependOnSeedAircraftAndPolicyStepAlone) {
  const Agent agent = Agent::Random(50);
  EXPECT_EQ(agent.EnvironmentFor({}).action_repeat, 50);
  constexpr int kCount = 20000;
  const Floats actions = ActionsOf(agent, {1, 0, 0}, kCount);
  double sum = 0, squares = 0;
  for (const float action : actions) {
    EXPECT_LE(std::abs(action), 1);
    sum += action;
    squares += static_cast<double>(action) * action;
  }
  // Five standard deviations of the means of 80,000 uniform numbers.
  EXPECT_NEAR(sum / (4 * kCount), 0, kStandardErrors * std::sqrt(1.0 / 3 / (4 * kCount)));
  EXPECT_NEAR(squares / (4 * kCount), 1.0 / 3,
              kStandardErrors * std::sqrt(4.0 / 45 / (4 * kCount)));
  EXPECT_EQ(Row(ActionsOf(agent, {1, 7, 0}, 1), 0), Row(actions, 7));
  EXPECT_NE(Row(ActionsOf(agent, {1, 7, 1}, 1), 0), Row(actions, 7));
  EXPECT_NE(Row(ActionsOf(agent, {2, 7, 0}, 1), 0), Row(actions, 7));
}

TEST(AgentTest, SampledActionsScatterAboutTheMean) {
  const RecurrentPolicy policy = SmallPolicy();
  const Floats mean = ActionsOf(Agent::MeanOf(policy), {}, 1);
  const Agent sampling = Agent::SamplingFrom(policy);
  EXPECT_EQ(sampling.EnvironmentFor({}).action_repeat, 5);
  constexpr int kCount = 20000;
  const Floats actions = ActionsOf(sampling, {1, 0, 0}, kCount);
  for (int k = 0; k < 4; ++k) {
    double sum = 0, squares = 0;
    for (int i = 0; i < kCount; ++i) {
      const double deviation = actions[4 * i + k] - mean[k];
      sum += deviation;
      squares += deviation * deviation;
    }
    const double sigma = std::exp(-1);
    EXPECT_NEAR(sum / kCount, 0, kStandardErrors * sigma / std::sqrt(kCount));
    EXPECT_NEAR(std::sqrt(squares / kCount), sigma,
                kStandardErrors * sigma / std::sqrt(2 * kCount));
  }
  constexpr Tolerance kProductShape{1e-5, "matrix products round by their shape"};
  const Floats alone = ActionsOf(sampling, {1, 7, 0}, 1);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(alone[k], Row(actions, 7)[k], kProductShape);
}

/// Of two rows of numbers of mean 0 and variance 1.
double Correlation(const Floats& x, const Floats& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += static_cast<double>(x[i]) * y[i];
  return sum / static_cast<double>(x.size());
}

TEST(AgentTest, SampledActionsAreDrawnAnewForEverySeedAircraftAndPolicyStep) {
  const RecurrentPolicy policy = SmallPolicy();
  const Agent sampling = Agent::SamplingFrom(policy);
  const Floats mean = ActionsOf(Agent::MeanOf(policy), {}, 1);
  constexpr int kCount = 5000;
  const auto noise_at = [&](const Agent::Turn& turn) {
    Floats noise = ActionsOf(sampling, turn, kCount);
    for (std::size_t i = 0; i < noise.size(); ++i) {
      noise[i] = (noise[i] - mean[i % 4]) / std::exp(-1.0f);
    }
    return noise;
  };
  const Floats noise = noise_at({1, 0, 0});
  constexpr std::uint64_t kOtherUpperHalf = 1 + (std::uint64_t{1} << 32);
  const Agent::Turn others[] = {{1, 0, 1}, {2, 0, 0}, {kOtherUpperHalf, 0, 0}, {1, kCount, 0}};
  for (const Agent::Turn& turn : others) {
    EXPECT_NEAR(Correlation(noise, noise_at(turn)), 0, kStandardErrors / std::sqrt(4 * kCount))
        << "seed " << turn.seed << ", aircraft " << turn.first_aircraft << ", policy step "
        << turn.policy_step;
  }
  EXPECT_EQ(noise_at({1, 0, 0}), noise) << "and by nothing else";
}

TEST(AgentTest, ARecurrentPolicyFliesByItsMeanWithItsLowLevelPolicyHoweverItIsGiven) {
  const auto low_level = std::make_shared<const RecurrentPolicy>(SmallPolicy());
  const RecurrentPolicy high_level =
      RecurrentPolicy::Untrained(SmallConfig().network, 22, 3, 3, 50, low_level);
  const Agent agent = Agent::Of(std::make_shared<RecurrentPolicy>(high_level));
  EXPECT_EQ(agent.low_level(), high_level.low_level());
  const Agent of_one = Agent::Of(low_level);
  EXPECT_EQ(of_one.low_level(), nullptr);
  EXPECT_EQ(ActionsOf(of_one, {}, 3), ActionsOf(Agent::MeanOf(*low_level), {}, 3));
}

TEST(AgentTest, AnyPolicyCanFly) {
  /// Remembers how many policy steps it has taken.
  class CountingPolicy final : public Policy {
   public:
    int observation_size() const override { return 22; }
    int action_size() const override { return 4; }
    int state_size() const override { return 1; }
    int action_repeat() const override { return 10; }
    void Act(int count, const float*, float* state, float* action) const override {
      for (int i = 0; i < count; ++i) {
        state[i] += 1;
        for (int k = 0; k < 4; ++k) action[4 * i + k] = state[i];
      }
    }
  };
  const Agent agent = Agent::Of(std::make_shared<CountingPolicy>());
  EXPECT_EQ(agent.EnvironmentFor({}).action_repeat, 10);
  EXPECT_EQ(agent.state_size(), 1);
  EXPECT_EQ(ActionsOf(agent, {}, 2), Floats(8, 1.0f));
}

}  // namespace
}  // namespace skein
