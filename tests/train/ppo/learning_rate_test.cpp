// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/learning_rate.h"

#include <gtest/gtest.h>

#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kRounding{1e-15, "float64 rounding of rates of about 1e-3"};

class AdaptedLearningRateTest : public testing::Test {
 protected:
  AdaptedLearningRateTest() {
    config_.learning_rate = 1e-3;
    config_.target_kl = 0.01;
  }

  PpoConfig config_;
};

TEST_F(AdaptedLearningRateTest, StaysWithinHalfAndTwiceTheTarget) {
  for (const double kl : {0.005, 0.01, 0.02}) {
    EXPECT_EQ(AdaptedLearningRate(config_, 3e-4, kl), 3e-4);
  }
}

TEST_F(AdaptedLearningRateTest, FallsAboveTwiceTheTargetAndRisesBelowHalf) {
  EXPECT_NEAR(AdaptedLearningRate(config_, 3e-4, 0.0201), 2e-4, kRounding);
  EXPECT_NEAR(AdaptedLearningRate(config_, 3e-4, 0.0049), 4.5e-4, kRounding);
}

TEST_F(AdaptedLearningRateTest, StaysWithinItsBounds) {
  EXPECT_NEAR(AdaptedLearningRate(config_, 1.1e-5, 1), 1e-5, kRounding);
  EXPECT_NEAR(AdaptedLearningRate(config_, 9e-4, 0), 1e-3, kRounding);
}

TEST(LargestLearningRateTest, FallsLinearlyToItsFraction) {
  PpoConfig config;
  config.learning_rate = 1e-3;
  config.final_learning_rate_fraction = 0.2;
  EXPECT_NEAR(LargestLearningRate(config, 0), 1e-3, kRounding);
  EXPECT_NEAR(LargestLearningRate(config, 0.5), 6e-4, kRounding);
  EXPECT_NEAR(LargestLearningRate(config, 1), 2e-4, kRounding);
}

TEST(LargestLearningRateTest, FallsBySharesThatAreAlwaysTheSame) {
  PpoConfig config;
  config.learning_rate = 1e-3;
  config.final_learning_rate_fraction = 0.04;
  config.learning_rate_decay = Decay::kExponential;
  EXPECT_NEAR(LargestLearningRate(config, 0), 1e-3, kRounding);
  EXPECT_NEAR(LargestLearningRate(config, 0.5), 2e-4, kRounding);
  EXPECT_NEAR(LargestLearningRate(config, 1), 4e-5, kRounding);
}

TEST(LearningRatesTest, TheCriticsIsTheActorsUnlessItHasItsOwnWhichFallsByTheSameShare) {
  PpoConfig config;
  config.learning_rate = 1e-4;
  config.final_learning_rate_fraction = 0.5;
  EXPECT_EQ(LearningRatesBeside(3e-6, config, 1).critic, 3e-6);
  config.critic_learning_rate = 1e-3;
  EXPECT_EQ(LearningRatesBeside(3e-6, config, 1).actor, 3e-6);
  EXPECT_NEAR(LearningRatesBeside(3e-6, config, 0).critic, 1e-3, kRounding);
  EXPECT_NEAR(LearningRatesBeside(3e-6, config, 1).critic, 5e-4, kRounding);
}

}  // namespace
}  // namespace skein
