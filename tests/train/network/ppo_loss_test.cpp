// SPDX-License-Identifier: Apache-2.0
#include "train/network/ppo_loss.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr int kSteps = 3, kBatch = 2, kSize = 2;
constexpr double kPairWeight = 0.25;
constexpr Tolerance kRounding{1e-6, "float32 exponentials and sums of a few terms of order one"};

/// Two sequences of three steps, actions of two components, of which the losses see nothing but
/// changes: advantages and the entropy bonus are zero.
class ActionChangeTest : public testing::Test {
 protected:
  LossSums Loss(const std::vector<float>& output) {
    SampleTile tile;
    tile.sequence = {kSteps, kBatch, nullptr, nullptr, not_done_.data()};
    tile.actor = {action_.data(), log_prob_.data(), advantage_.data()};
    gradient_.assign(output.size(), 1e9f);
    float log_std_gradient[kSize] = {};
    return ActorLoss(tile, kSize, settings_, output.data(), log_std_.data(), gradient_.data(),
                     log_std_gradient);
  }

  void SetUp() override {
    settings_.entropy_coefficient = 0;
    settings_.tanh_mean = false;
    settings_.action_smoothness_coefficient = 3;
    settings_.pair_weight = kPairWeight;
  }

  LossSettings settings_;
  std::vector<float> not_done_ = std::vector<float>(kSteps * kBatch, 1.0f);
  std::vector<float> gradient_;

 private:
  const std::vector<float> action_ = std::vector<float>(kSteps * kBatch * kSize, 0.1f);
  const std::vector<float> log_prob_ = std::vector<float>(kSteps * kBatch, 0.0f);
  const std::vector<float> advantage_ = log_prob_;
  const std::vector<float> log_std_ = std::vector<float>(kSize, 0.0f);
};

TEST_F(ActionChangeTest, IsTheSumOfSquaresOverPairsOfTheSameSequence) {
  // Sequence 0 moves by (0.1, 0) and (0, 0.3); sequence 1 rests, elsewhere.
  const std::vector<float> output{0, 0, 7, 7, 0.1f, 0, 7, 7, 0.1f, 0.3f, 7, 7};
  EXPECT_NEAR(Loss(output).action_change, kPairWeight * (0.01 + 0.09), kRounding);
  const float factor = 2 * 3 * kPairWeight;
  const std::vector<float> expected{factor * -0.1f, 0, 0, 0, factor * 0.1f, factor * -0.3f, 0, 0, 0,
                                    factor * 0.3f,  0, 0};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(gradient_[i], expected[i], kRounding) << i;
  }
}

TEST_F(ActionChangeTest, PairsThatAnEpisodeSeparatesDoNotCount) {
  const std::vector<float> output{0, 0, 0, 0, 5, 5, 0, 0, 5, 5, 0, 0};
  not_done_[1 * kBatch + 0] = 0;
  EXPECT_EQ(Loss(output).action_change, 0);
  for (const float value : gradient_) EXPECT_EQ(value, 0);
}

TEST_F(ActionChangeTest, IsMeasuredBehindTanhAndWithoutAPriceToo) {
  settings_.tanh_mean = true;
  settings_.action_smoothness_coefficient = 0;
  const std::vector<float> output{0, 0, 0, 0, 100, 0, 0, 0, 100, 0, 0, 0};
  EXPECT_NEAR(Loss(output).action_change, kPairWeight, kRounding);
  for (const float value : gradient_) EXPECT_EQ(value, 0);
}

/// One action of one component, 0.5 beside its mean of 0, with a standard deviation of 1.
struct Surrogate {
  /// Of an action that is `ratio` times as likely as when it was taken.
  Surrogate(double ratio, float advantage) {
    const float output = 0, action = 0.5f, log_std = 0, not_done = 1;
    float old_log_prob = 0;
    LogProbability(1, 1, &output, &log_std, &action, &old_log_prob);
    old_log_prob -= static_cast<float>(std::log(ratio));
    SampleTile tile;
    tile.sequence = {1, 1, nullptr, nullptr, &not_done};
    tile.actor = {&action, &old_log_prob, &advantage};
    LossSettings settings;
    settings.clip = 0.2;
    settings.entropy_coefficient = 0;
    settings.tanh_mean = false;
    sums = ActorLoss(tile, 1, settings, &output, &log_std, &mean_gradient, &log_std_gradient);
  }

  LossSums sums;
  float mean_gradient = 0, log_std_gradient = 0;
};

TEST(SurrogateTest, GainsNothingByLeavingTheClip) {
  for (const auto& [ratio, advantage, loss] :
       {std::tuple{1.3, 2.0f, -2.4}, std::tuple{0.7, -2.0f, 1.6}}) {
    const Surrogate left(ratio, advantage);
    EXPECT_NEAR(left.sums.policy_loss, loss, kRounding) << ratio;
    EXPECT_EQ(left.mean_gradient, 0) << ratio;
    EXPECT_EQ(left.log_std_gradient, 0) << ratio;
    EXPECT_EQ(left.sums.clip_fraction, 1) << ratio;
  }
}

TEST(SurrogateTest, ElsewhereIsTheRatioTimesTheAdvantage) {
  // d ratio / d mean = ratio * 0.5, d ratio / d log_std = ratio * (0.25 - 1).
  for (const auto& [ratio, advantage, clipped] :
       {std::tuple{1.3, -2.0f, 1}, std::tuple{0.7, 2.0f, 1}, std::tuple{1.1, 2.0f, 0}}) {
    const Surrogate inside(ratio, advantage);
    const double loss = -ratio * advantage;
    EXPECT_NEAR(inside.sums.policy_loss, loss, kRounding) << ratio;
    EXPECT_NEAR(inside.mean_gradient, loss * 0.5, kRounding) << ratio;
    EXPECT_NEAR(inside.log_std_gradient, loss * -0.75, kRounding) << ratio;
    EXPECT_NEAR(inside.sums.approximate_kl, ratio - 1 - std::log(ratio), kRounding) << ratio;
    EXPECT_EQ(inside.sums.clip_fraction, clipped) << ratio;
  }
}

TEST(CriticLossTest, TheClipTakesTheLargerError) {
  LossSettings settings;
  settings.clip = 0.2;
  settings.clip_value_loss = true;
  const float target = 0, old_value = 1;
  // Moved by -0.5 the value is near its target; by -0.2, which is all that counts, it is not yet.
  for (const auto& [value, error, gradient] :
       {std::tuple{0.5f, 0.8, 0.0}, std::tuple{1.5f, 1.5, 1.5}, std::tuple{0.9f, 0.9, 0.9}}) {
    SampleTile tile;
    tile.sequence = {1, 1, nullptr, nullptr, nullptr};
    tile.target = &target;
    tile.old_value = &old_value;
    float value_gradient = 0;
    EXPECT_NEAR(CriticLoss(tile, settings, &value, &value_gradient).value_loss, error * error / 2,
                kRounding);
    EXPECT_NEAR(value_gradient, gradient, kRounding) << value;
  }
}

}  // namespace
}  // namespace skein
