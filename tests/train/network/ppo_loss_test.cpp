// SPDX-License-Identifier: Apache-2.0
#include "train/network/ppo_loss.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr int kSteps = 3, kBatch = 2, kSize = 2;
constexpr double kPairWeight = 0.25;
constexpr Tolerance kRounding{1e-6, "float32 sums of a few terms of order one"};

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

}  // namespace
}  // namespace skein
