// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/reward_and_termination.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "envs/air/atmosphere.h"
#include "envs/aircraft/f16.h"
#include "envs/env_config.h"
#include "envs/kernels/plant_kernel.h"
#include "envs/state/attitude.h"
#include "tests/envs/test_tile.h"
#include "tests/scoped_target.h"

namespace skein {
namespace {

constexpr double kAltitude = 20000;

class RewardAndTerminationTest : public testing::TestWithParam<simd::Target> {
 protected:
  RewardAndTerminationTest() {
    for (int i = 0; i < kCount; ++i) SetFlight(i, 1000, 3, 0, kAltitude);
  }

  void SetFlight(int i, double speed, double alpha_deg, double beta_deg, double altitude_ft) {
    const double alpha = alpha_deg / kDegPerRad, beta = beta_deg / kDegPerRad;
    flight_.at(kQ0, i) = 1;
    flight_.at(kU, i) = static_cast<float>(speed * std::cos(alpha) * std::cos(beta));
    flight_.at(kV, i) = static_cast<float>(speed * std::sin(beta));
    flight_.at(kW, i) = static_cast<float>(speed * std::sin(alpha) * std::cos(beta));
    flight_.at(kDown, i) = static_cast<float>(-altitude_ft);
    flight_.at(kNz, i) = 1;
  }
  void ComputeReward() {
    StepResult step_result{reward_.data(), reached_.data()};
    step_result.bonus = bonus_.data();
    ComputeRewardAndTermination(
        *kernel_, TerminationLimits(config_.termination, config_.episode()), flight_.tile(),
        step_result, {step_.data(), termination_.data(), policy_step_.data(), return_.data()});
  }
  Termination Of(int i) const {
    return static_cast<Termination>(termination_[static_cast<std::size_t>(i)]);
  }

  static constexpr int kCount = 40;
  ScopedTarget target_{GetParam()};
  std::shared_ptr<const KernelAircraft> kernel_ =
      MakeKernelAircraft(F16(), AtmosphereModel::kStevensLewis);
  EnvConfig config_;
  TestTile flight_{kCount};
  std::vector<float> reward_ = std::vector<float>(flight_.stride(), -0.5f);
  std::vector<float> bonus_ = std::vector<float>(flight_.stride());
  std::vector<std::int32_t> reached_ = std::vector<std::int32_t>(flight_.stride());
  std::vector<std::int32_t> step_ = std::vector<std::int32_t>(flight_.stride(), 10);
  std::vector<std::int32_t> termination_ = std::vector<std::int32_t>(flight_.stride());
  std::vector<float> policy_step_ = std::vector<float>(flight_.stride());
  std::vector<float> return_ = std::vector<float>(flight_.stride(), -3);
};

TEST_P(RewardAndTerminationTest, FlyingOnCostsTheTaskRewardAndAStep) {
  config_.reward_scale = 0.5;
  ComputeReward();
  for (std::size_t i = 0; i < kCount; ++i) {
    EXPECT_EQ(termination_[i], static_cast<std::int32_t>(Termination::kNone));
    EXPECT_EQ(step_[i], 11);
    EXPECT_FLOAT_EQ(policy_step_[i], -0.25f);
    EXPECT_FLOAT_EQ(return_[i], -3.25f);
  }
}

TEST_P(RewardAndTerminationTest, EveryLimitEndsTheEpisodeOnItsFarSideOnly) {
  const double sound = AirAt(AtmosphereModel::kStevensLewis, kAltitude).sound_speed_ft_s;
  struct Case {
    double speed, alpha_deg, beta_deg, altitude_ft, nz;
    Termination expected;
  };
  const std::vector<Case> cases = {
      {1000, -19.9, 0, kAltitude, 1, Termination::kNone},
      {1000, -20.1, 0, kAltitude, 1, Termination::kExtremeState},
      {1000, 44.9, 0, kAltitude, 1, Termination::kNone},
      {1000, 45.1, 0, kAltitude, 1, Termination::kExtremeState},
      {1000, 170, 0, kAltitude, 1, Termination::kExtremeState},
      {1000, 3, 29.9, kAltitude, 1, Termination::kNone},
      {1000, 3, 30.1, kAltitude, 1, Termination::kExtremeState},
      {1000, 3, -30.1, kAltitude, 1, Termination::kExtremeState},
      {2.99 * sound, 3, 0, kAltitude, 1, Termination::kNone},
      {3.01 * sound, 3, 0, kAltitude, 1, Termination::kHighSpeed},
      {1000, 3, 0, 2501, 1, Termination::kNone},
      {1000, 3, 0, 2499, 1, Termination::kLowAltitude},
      {0.0101 * sound, 3, 0, kAltitude, 1, Termination::kNone},
      {0.0099 * sound, 3, 0, kAltitude, 1, Termination::kLowSpeed},
      // Of the whole airspeed, sideslip included.
      {2.99 * sound, 3, 29, kAltitude, 1, Termination::kNone},
      {3.01 * sound, 3, 29, kAltitude, 1, Termination::kHighSpeed},
      {0.0101 * sound, 3, 29, kAltitude, 1, Termination::kNone},
      {0.0099 * sound, 3, 29, kAltitude, 1, Termination::kLowSpeed},
      {1000, 3, 0, kAltitude, 9.99, Termination::kNone},
      {1000, 3, 0, kAltitude, 10.01, Termination::kOverload},
      {1000, 3, 0, kAltitude, -10.01, Termination::kNone},
      // The first of several wins.
      {1000, 60, 0, 2000, 20, Termination::kExtremeState},
      {4 * sound, 3, 0, 2000, 20, Termination::kHighSpeed},
      {1000, 3, 0, 2000, 20, Termination::kLowAltitude},
  };
  for (int i = 0; i < static_cast<int>(cases.size()); ++i) {
    const Case& c = cases[static_cast<std::size_t>(i)];
    SetFlight(i, c.speed, c.alpha_deg, c.beta_deg, c.altitude_ft);
    flight_.at(kNz, i) = static_cast<float>(c.nz);
  }
  ComputeReward();
  for (int i = 0; i < static_cast<int>(cases.size()); ++i) {
    const Case& c = cases[static_cast<std::size_t>(i)];
    EXPECT_EQ(Of(i), c.expected) << "case " << i;
    const double terminal = c.expected == Termination::kNone ? 0 : -200;
    EXPECT_FLOAT_EQ(policy_step_[static_cast<std::size_t>(i)], static_cast<float>(-0.5 + terminal));
  }
}

TEST_P(RewardAndTerminationTest, SuccessAndTimeLimit) {
  step_[0] = 2498;
  step_[1] = 2499;
  step_[2] = 2499;
  reached_[2] = 1;
  reached_[3] = 1;
  reached_[4] = 1;
  flight_.at(kNz, 4) = 11;
  ComputeReward();
  EXPECT_EQ(Of(0), Termination::kNone);
  EXPECT_EQ(Of(1), Termination::kTimeLimit);
  EXPECT_FLOAT_EQ(policy_step_[1], -200.5f);
  EXPECT_EQ(Of(2), Termination::kTargetReached);
  EXPECT_FLOAT_EQ(policy_step_[2], 199.5f);
  EXPECT_EQ(Of(3), Termination::kTargetReached);
  EXPECT_EQ(Of(4), Termination::kOverload);
}

TEST_P(RewardAndTerminationTest, TheScaleIsOfStepRewardsAlone) {
  config_.reward_scale = 0.5;
  bonus_[0] = 40;  // of a target after which the flight goes on
  reached_[1] = 1;
  flight_.at(kNz, 2) = 11;
  ComputeReward();
  EXPECT_FLOAT_EQ(policy_step_[0], -0.25f + 40);
  EXPECT_FLOAT_EQ(policy_step_[1], -0.25f + 200);
  EXPECT_FLOAT_EQ(policy_step_[2], -0.25f - 200);
}

TEST_P(RewardAndTerminationTest, BeingLateCostsItsFactorOfAFailureWhichCostsTheSame) {
  config_.termination.late_reward_factor = 0.25;
  step_[0] = 2499;
  flight_.at(kNz, 1) = 11;
  ComputeReward();
  EXPECT_EQ(Of(0), Termination::kTimeLimit);
  EXPECT_FLOAT_EQ(policy_step_[0], -50.5f);
  EXPECT_EQ(Of(1), Termination::kOverload);
  EXPECT_FLOAT_EQ(policy_step_[1], -200.5f);
}

TEST_P(RewardAndTerminationTest, TruncationHasNoTerminalReward) {
  config_.truncate_at_time_limit = true;
  config_.termination.late_reward_factor = 2;
  step_[0] = 2499;
  ComputeReward();
  EXPECT_EQ(Of(0), Termination::kTimeLimit);
  EXPECT_FLOAT_EQ(policy_step_[0], -0.5f);
}

TEST_P(RewardAndTerminationTest, AnEndedEpisodeIsLeftAlone) {
  termination_[7] = static_cast<std::int32_t>(Termination::kTargetReached);
  policy_step_[7] = 12;
  SetFlight(7, 1000, 80, 0, kAltitude);
  flight_.at(kP, 7) = std::numeric_limits<float>::quiet_NaN();
  ComputeReward();
  EXPECT_EQ(Of(7), Termination::kTargetReached);
  EXPECT_EQ(step_[7], 10);
  EXPECT_EQ(policy_step_[7], 12);
  EXPECT_EQ(return_[7], -3);
}

TEST_P(RewardAndTerminationTest, AnythingNotFiniteEndsOnlyItsOwnEpisode) {
  const float bad[3] = {std::numeric_limits<float>::quiet_NaN(),
                        std::numeric_limits<float>::infinity(),
                        -std::numeric_limits<float>::infinity()};
  for (int column = 0; column < kNumColumns; ++column) {
    const float before = flight_.at(column, 5);
    flight_.at(column, 5) = bad[column % 3];
    std::fill(termination_.begin(), termination_.end(), 0);
    std::fill(policy_step_.begin(), policy_step_.end(), 0.0f);
    ComputeReward();
    for (int i = 0; i < kCount; ++i) {
      EXPECT_EQ(Of(i), i == 5 ? Termination::kNonFinite : Termination::kNone) << column;
    }
    EXPECT_FLOAT_EQ(policy_step_[5], -200);
    flight_.at(column, 5) = before;
  }
  std::fill(termination_.begin(), termination_.end(), 0);
  reward_[6] = bad[0];
  ComputeReward();
  EXPECT_EQ(Of(6), Termination::kNonFinite);
  EXPECT_TRUE(std::isfinite(return_[6]));
}

INSTANTIATE_TEST_SUITE_P(Targets, RewardAndTerminationTest,
                         testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& test) { return std::string(Name(test.param)); });

}  // namespace
}  // namespace skein
