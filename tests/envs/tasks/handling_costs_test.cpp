// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/handling_costs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "envs/state/attitude.h"
#include "envs/tasks/task.h"
#include "tests/envs/test_tile.h"
#include "tests/scoped_target.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kRounding{2e-6, "float32 of costs near one, with estimates of roots"};

class HandlingCostsTest : public testing::TestWithParam<simd::Target> {
 protected:
  HandlingCostsTest() {
    flight_.Fill(kU, 1000);
    flight_.Fill(kQ0, 1);
    flight_.Fill(kNz, 1);
  }

  void SetAttitude(double roll_rad, double pitch_rad) {
    EulerAngles angles;
    angles.roll = roll_rad;
    angles.pitch = pitch_rad;
    const Eigen::Vector4d attitude = QuaternionFromEuler(angles);
    for (int k = 0; k < 4; ++k) flight_.Fill(kQ0 + k, static_cast<float>(attitude[k]));
  }
  void SetError(double error) { errors_.assign(errors_.size(), static_cast<float>(error)); }

  /// What a control step of the last aircraft costs.
  double Cost() {
    std::vector<float> reward(flight_.stride(), 0.5f);
    SubtractHandlingCosts(costs_, flight_.tile(), errors_.data(), flight_.stride(),
                          reached_step_.empty() ? nullptr : reached_step_.data(), reward.data());
    return 0.5 - reward[kCount - 1];
  }

  static constexpr int kCount = 37;
  ScopedTarget target_{GetParam()};
  HandlingCosts costs_;
  TestTile flight_{kCount};
  std::vector<float> errors_ = std::vector<float>(kNumTaskErrors * flight_.stride());
  std::vector<std::int32_t> reached_step_;
};

TEST_P(HandlingCostsTest, EveryRateCostsItsWeightWhateverItsSign) {
  costs_.near_roll_rate = 0.1;
  costs_.near_pitch_rate = 0.2;
  costs_.near_yaw_rate = 0.4;
  EXPECT_NEAR(Cost(), 0, kRounding);
  flight_.Fill(kP, -0.5f);
  EXPECT_NEAR(Cost(), 0.05, kRounding);
  flight_.Fill(kQ, 0.25f);
  EXPECT_NEAR(Cost(), 0.1, kRounding);
  flight_.Fill(kR, -0.125f);
  EXPECT_NEAR(Cost(), 0.15, kRounding);
}

TEST_P(HandlingCostsTest, NearTermsFadeWithTheErrorAndOthersDoNot) {
  costs_.near_roll_rate = 0.1;
  costs_.roll_rate = 0.01;
  costs_.near_sharpness = 20;
  flight_.Fill(kP, 1);
  SetError(0.1);
  EXPECT_NEAR(Cost(), 0.1 / (1 + 20 * 3 * 0.01) + 0.01, kRounding);
  SetError(1000);
  EXPECT_NEAR(Cost(), 0.01, kRounding);
}

TEST_P(HandlingCostsTest, NearTermsDoNotFadeBelowTheFloorOnceTheTargetCounts) {
  costs_.near_roll_rate = 0.1;
  costs_.near_sharpness = 20;
  costs_.near_floor = 0.5;
  flight_.Fill(kP, 1);
  SetError(1000);
  EXPECT_NEAR(Cost(), 0, kRounding);
  reached_step_.assign(flight_.stride(), 0);
  EXPECT_NEAR(Cost(), 0, kRounding);
  reached_step_.assign(flight_.stride(), 70);
  EXPECT_NEAR(Cost(), 0.05, kRounding);
  SetError(0.1);
  EXPECT_NEAR(Cost(), 0.1 / (1 + 20 * 3 * 0.01), kRounding);
}

TEST_P(HandlingCostsTest, UnacceleratedFlightCostsNothingInAnyAttitude) {
  costs_.near_load_factor = 0.5;
  for (const double roll : {0.0, 1.0, -2.5}) {
    for (const double pitch : {0.0, 0.5, -1.2}) {
      SetAttitude(roll, pitch);
      const double free = std::cos(roll) * std::cos(pitch);
      flight_.Fill(kNz, static_cast<float>(free));
      EXPECT_NEAR(Cost(), 0, kRounding);
      flight_.Fill(kNz, static_cast<float>(free - 0.3));
      EXPECT_NEAR(Cost(), 0.15, kRounding);
    }
  }
}

TEST_P(HandlingCostsTest, ABankCostsOneLessItsCosineWhateverThePitch) {
  costs_.near_bank = 1;
  for (const double pitch : {0.0, 0.7, -1.2}) {
    for (const double roll : {0.0, 0.6, -1.5, 3.0}) {
      SetAttitude(roll, pitch);
      EXPECT_NEAR(Cost(), 1 - std::cos(roll), kRounding);
    }
  }
}

TEST_P(HandlingCostsTest, SideslipCostsItsSineToEitherSide) {
  costs_.sideslip = 0.3;
  for (const float side : {-100.0f, 100.0f}) {
    flight_.Fill(kV, side);
    EXPECT_NEAR(Cost(), 0.3 * 100 / std::hypot(1000, 100), kRounding);
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, HandlingCostsTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& test) { return std::string(Name(test.param)); });

class TolerancesTest : public testing::TestWithParam<simd::Target> {
 protected:
  /// `reward` after a control step of as many aircraft; without `reached_step` none is remembered.
  static std::vector<float> Rewarded(const HandlingCosts& costs, std::vector<float> reward,
                                     std::vector<std::int32_t> within,
                                     std::vector<std::int32_t> reached_step = {}) {
    const std::size_t count = reward.size(), padded = TileStride(static_cast<int>(count));
    const bool is_remembered = !reached_step.empty();
    reward.resize(padded);
    within.resize(padded);
    reached_step.resize(padded);
    RewardTolerances(costs, static_cast<int>(count), within.data(),
                     is_remembered ? reached_step.data() : nullptr, reward.data());
    reward.resize(count);
    return reward;
  }

  const ScopedTarget target_{GetParam()};
};

TEST_P(TolerancesTest, GiveWithinThemAndTakeOutside) {
  HandlingCosts costs;
  EXPECT_FALSE(costs.enabled());
  costs.within_tolerances = 0.25;
  EXPECT_EQ(Rewarded(costs, {-1, -1, 0.5f}, {1, 0, 1}), (std::vector<float>{-0.75f, -1, 0.75f}));

  costs = {};
  costs.outside_tolerances = 0.5;
  EXPECT_TRUE(costs.enabled());
  EXPECT_EQ(Rewarded(costs.Times(0.5), {-0.75f, -1, 0.75f}, {1, 0, 1}),
            (std::vector<float>{-0.75f, -1.25f, 0.75f}));
}

TEST_P(TolerancesTest, TakeBeforeTheTargetIsReachedWithinThemOrNot) {
  HandlingCosts costs;
  costs.before_reached = 0.5;
  EXPECT_TRUE(costs.enabled());
  EXPECT_EQ(Rewarded(costs.Times(0.5), {1, 1, 1, 1}, {1, 0, 1, 0}, {0, 0, 70, 70}),
            (std::vector<float>{0.75f, 0.75f, 1, 1}));
  EXPECT_EQ(Rewarded(costs, {0.75f, 0.75f, 1, 1}, {1, 0, 1, 0}),
            (std::vector<float>{0.25f, 0.25f, 0.5f, 0.5f}));
}

INSTANTIATE_TEST_SUITE_P(Targets, TolerancesTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& test) { return std::string(Name(test.param)); });

TEST(ActionChange, CostsTheSquaresOfClippedChangesBesideTheFirst) {
  HandlingCosts costs;
  costs.action_change = 0.5;
  TestTile memory(2, 4);
  const std::vector<float> first = {1, 0.5f, -0.5f, 0, 0, 0, 0, 0};
  const std::vector<float> second = {-1, 3, -0.5f, 0.25f, 1, 0, 0, 0};
  std::vector<float> reward = {0, 0};
  SubtractActionChange(costs, first.data(), 4, 1, memory.tile(), reward.data());
  EXPECT_FLOAT_EQ(reward[0], -0.5f * 0.5f);
  EXPECT_FLOAT_EQ(reward[1], 0);
  reward = {0, 0};
  SubtractActionChange(costs, second.data(), 4, 1, memory.tile(), reward.data());
  EXPECT_FLOAT_EQ(reward[0], -0.5f * (0.25f + 0.0625f));
  EXPECT_FLOAT_EQ(reward[1], 0);
}

}  // namespace
}  // namespace skein
