// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/heading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "envs/state/attitude.h"
#include "envs/task_registry.h"
#include "tests/envs/test_tile.h"
#include "tests/extremes.h"
#include "tests/scoped_target.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kFloat32{2e-6, "float32 rounding of angles and square roots near one"};
constexpr Tolerance kEnds{1e-5, "float32 rounding at the ends of a range"};
constexpr double kFtPerKm = 1000 / 0.3048;

class HeadingTest : public testing::TestWithParam<simd::Target> {
 protected:
  void SetAttitude(int i, double roll, double pitch, double yaw) {
    const Eigen::Vector4d q = QuaternionFromEuler({roll, pitch, yaw});
    for (int k = 0; k < 4; ++k) flight_.at(kQ0 + k, i) = static_cast<float>(q[k]);
  }
  void SetTarget(int i, double altitude_ft, double yaw, double speed_ft_s, double share = 1) {
    targets_.at(kTargetTolerance, i) = static_cast<float>(share);
    targets_.at(kTargetAltitude, i) = static_cast<float>(altitude_ft);
    targets_.at(kTargetYaw, i) = static_cast<float>(yaw);
    targets_.at(kTargetSpeed, i) = static_cast<float>(speed_ft_s);
  }
  /// Level flight at 20,000 ft and 1000 ft/s towards `yaw`.
  void SetLevel(int i, double yaw) {
    SetAttitude(i, 0, 0, yaw);
    flight_.at(kDown, i) = -20000;
    flight_.at(kU, i) = 800;
    flight_.at(kW, i) = 600;
  }
  std::vector<float> Errors() {
    std::vector<float> errors(kNumTaskErrors * flight_.stride());
    task_->Errors(flight_.tile(), targets_.tile(), errors.data(), flight_.stride());
    return errors;
  }
  void ComputeReward() {
    task_->ComputeReward(flight_.tile(), targets_.tile(), steps_.data(),
                         {reward_.data(), reached_.data()});
  }

  static constexpr int kCount = 37;
  ScopedTarget target_{GetParam()};
  EnvConfig config_;
  std::unique_ptr<Task> task_ = MakeTask(config_);
  TestTile flight_{kCount};
  TestTile targets_{kCount, kNumHeadingColumns};
  std::vector<float> reward_ = std::vector<float>(flight_.stride());
  std::vector<std::int32_t> reached_ = std::vector<std::int32_t>(flight_.stride());
  std::vector<std::int32_t> steps_ = std::vector<std::int32_t>(flight_.stride(), 1000);
};

TEST_P(HeadingTest, ErrorsAreTargetMinusActualInTheirUnits) {
  for (int i = 0; i < kCount; ++i) {
    SetLevel(i, 0.5);
    SetTarget(i, 20000 + 0.3 * kFtPerKm, 0.5 - 0.4, 1000 + 0.1 * 340 / 0.3048);
  }
  const std::vector<float> errors = Errors();
  for (int i = 0; i < kCount; ++i) {
    const auto index = static_cast<std::size_t>(i);
    EXPECT_NEAR(errors[index], 0.3, kFloat32);
    EXPECT_NEAR(errors[flight_.stride() + index], -0.4, kFloat32);
    EXPECT_NEAR(errors[2 * flight_.stride() + index], 0.1, kFloat32);
  }
  const std::vector<TargetQuantity> quantities = task_->target_quantities();
  EXPECT_DOUBLE_EQ(quantities[0].error_unit, kFtPerKm);
  EXPECT_DOUBLE_EQ(quantities[1].error_unit, kDegPerRad);
  EXPECT_DOUBLE_EQ(quantities[2].error_unit, 340 / 0.3048);
  EXPECT_EQ(quantities[0].tolerance, config_.heading.altitude_tolerance_ft);
  EXPECT_EQ(quantities[1].tolerance, config_.heading.yaw_tolerance_deg);
  EXPECT_EQ(quantities[2].tolerance, config_.heading.speed_tolerance_fps);
}

TEST_P(HeadingTest, YawErrorTakesTheShortWayRound) {
  constexpr double kStep = 0.17;
  for (int i = 0; i < kCount; ++i) {
    SetAttitude(i, 0.3, -0.2, std::remainder(kStep * i, 2 * M_PI));
    SetTarget(i, 0, std::remainder(-2.3 * kStep * i, 2 * M_PI), 0);
  }
  const std::vector<float> errors = Errors();
  for (int i = 0; i < kCount; ++i) {
    const double expected = std::remainder(-3.3 * kStep * i, 2 * M_PI);
    const double actual = errors[flight_.stride() + static_cast<std::size_t>(i)];
    EXPECT_LE(std::abs(actual), M_PI + kFloat32);
    EXPECT_NEAR(std::remainder(actual - expected, 2 * M_PI), 0, kFloat32) << i;
  }
}

TEST_P(HeadingTest, RewardIsMinusTheNormOfTheErrors) {
  SetLevel(0, 0);
  SetTarget(0, 20000 - 0.2 * kFtPerKm, 0.3, 1000 + 0.6 * 340 / 0.3048);
  ComputeReward();
  EXPECT_NEAR(reward_[0], -0.7, kFloat32);
}

TEST_P(HeadingTest, TheNormCostsItsWeightBesideTheSingleErrors) {
  config_.heading.error_norm_weight = 0.5;
  config_.heading.speed_error_weight = 3;
  task_ = MakeTask(config_);
  SetLevel(0, 0);
  SetTarget(0, 20000 - 0.2 * kFtPerKm, 0.3, 1000 + 0.6 * 340 / 0.3048);
  ComputeReward();
  EXPECT_NEAR(reward_[0], -(0.5 * 0.7 + 3 * 0.6), 2 * kFloat32);
}

TEST_P(HeadingTest, SpeedErrorsCostTheirWeightBesideTheNorm) {
  config_.heading.speed_error_weight = 3;
  task_ = MakeTask(config_);
  for (const int side : {0, 1}) {
    const double faster = (side == 0 ? 0.6 : -0.6) * 340 / 0.3048;
    SetLevel(side, 0);
    SetTarget(side, 20000 - 0.2 * kFtPerKm, 0.3, 1000 + faster);
  }
  ComputeReward();
  EXPECT_NEAR(reward_[0], -(0.7 + 3 * 0.6), 2 * kFloat32);
  EXPECT_NEAR(reward_[1], reward_[0], 2 * kFloat32);
}

TEST_P(HeadingTest, AltitudeErrorsCostTheirWeightBesideTheNorm) {
  config_.heading.altitude_error_weight = 2;
  task_ = MakeTask(config_);
  for (const int side : {0, 1}) {
    SetLevel(side, 0);
    SetTarget(side, 20000 + (side == 0 ? 0.2 : -0.2) * kFtPerKm, 0.3, 1000 + 0.6 * 340 / 0.3048);
  }
  ComputeReward();
  EXPECT_NEAR(reward_[0], -(0.7 + 2 * 0.2), 2 * kFloat32);
  EXPECT_NEAR(reward_[1], reward_[0], 2 * kFloat32);
}

TEST_P(HeadingTest, YawErrorsCostTheirWeightBesideTheNorm) {
  config_.heading.yaw_error_weight = 2;
  task_ = MakeTask(config_);
  for (const int side : {0, 1}) {
    SetLevel(side, 0);
    SetTarget(side, 20000 - 0.2 * kFtPerKm, side == 0 ? 0.3 : -0.3, 1000 + 0.6 * 340 / 0.3048);
  }
  ComputeReward();
  EXPECT_NEAR(reward_[0], -(0.7 + 2 * 0.3), 2 * kFloat32);
  EXPECT_NEAR(reward_[1], reward_[0], 2 * kFloat32);
}

TEST_P(HeadingTest, MirroredErrorsGetTheSameReward) {
  for (const int side : {0, 1}) {
    const double sign = side == 0 ? 1 : -1;
    SetLevel(side, sign * 0.8);
    SetTarget(side, 20500, sign * -1.1, 1100);
  }
  ComputeReward();
  EXPECT_EQ(reward_[0], reward_[1]);
}

TEST_P(HeadingTest, IsReachedOnlyInsideAllTolerancesAndNotEarly) {
  struct Case {
    double altitude_ft, yaw_deg, speed_ft_s;
    int steps_before;
    bool reached;
  };
  const std::vector<Case> cases = {
      {99, 4.9, 19, 1000, true}, {-99, -4.9, -19, 1000, true}, {101, 0, 0, 1000, false},
      {-101, 0, 0, 1000, false}, {0, 5.1, 0, 1000, false},     {0, -5.1, 0, 1000, false},
      {0, 0, 21, 1000, false},   {0, 0, -21, 1000, false},     {0, 0, 0, 298, false},
      {0, 0, 0, 299, true},      {0, 0, 0, 0, false},
  };
  for (int i = 0; i < static_cast<int>(cases.size()); ++i) {
    const Case& c = cases[static_cast<std::size_t>(i)];
    SetLevel(i, 3.1);
    SetTarget(i, 20000 + c.altitude_ft, std::remainder(3.1 + c.yaw_deg / kDegPerRad, 2 * M_PI),
              1000 + c.speed_ft_s);
    steps_[static_cast<std::size_t>(i)] = c.steps_before;
  }
  ComputeReward();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    EXPECT_EQ(reached_[i], cases[i].reached ? 1 : 0) << "case " << i;
  }
}

TEST_P(HeadingTest, TolerancesAreTheEpisodesShare) {
  struct Case {
    double altitude_ft, yaw_deg, speed_ft_s;
    bool reached;
  };
  const std::vector<Case> cases = {{49, 2.4, 9, true},   {-49, -2.4, -9, true}, {51, 0, 0, false},
                                   {0, 2.6, 0, false},   {0, 0, 11, false},     {0, 0, -11, false},
                                   {-51, 2.4, 9, false}, {0, -2.6, 0, false}};
  for (int i = 0; i < static_cast<int>(cases.size()); ++i) {
    const Case& c = cases[static_cast<std::size_t>(i)];
    SetLevel(i, 0.5);
    SetTarget(i, 20000 + c.altitude_ft, 0.5 + c.yaw_deg / kDegPerRad, 1000 + c.speed_ft_s, 0.5);
  }
  ComputeReward();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    EXPECT_EQ(reached_[i], cases[i].reached ? 1 : 0) << "case " << i;
  }
}

TEST_P(HeadingTest, SharesAreDrawnByEpisodeForTrainingAlone) {
  config_.heading.training_tolerance_min = 0.2;
  const std::unique_ptr<Task> training = MakeTask(config_);
  const std::unique_ptr<Task> evaluation = MakeTask(EvaluationConfig(config_));
  double least = 1, most = 0, mean = 0;
  constexpr int kEpisodes = 2000;
  for (std::uint32_t episode = 0; episode < kEpisodes; ++episode) {
    const auto share_of = [this, episode](const Task& task) {
      simd::RandomStream random({5, 0, episode, 0, simd::RandomPurpose::kTarget});
      task.Reset({20000, 1100, 0, 1}, &random, targets_.tile(), 0);
      return targets_.at(kTargetTolerance, 0);
    };
    EXPECT_EQ(share_of(*evaluation), 1);
    const double share = share_of(*training);
    least = std::min(least, share);
    most = std::max(most, share);
    mean += share / kEpisodes;
  }
  EXPECT_GE(least, 0.2);
  EXPECT_LT(least, 0.21);
  EXPECT_GT(most, 0.99);
  EXPECT_NEAR(mean, 0.6, kStandardErrors * 0.4 / std::sqrt(12.0 * kEpisodes));
}

TEST_P(HeadingTest, TargetsAreDrawnAroundTheStart) {
  double least[3] = {1e9, 1e9, 1e9}, most[3] = {-1e9, -1e9, -1e9};
  for (std::uint32_t episode = 0; episode < 2000; ++episode) {
    simd::RandomStream random({5, 0, episode, 0, simd::RandomPurpose::kTarget});
    TestTile target(1, kNumHeadingColumns);
    task_->Reset({20000, 1100, 0, 1}, &random, target.tile(), 0);
    const double yaw = target.at(kTargetYaw, 0);
    const double change[3] = {target.at(kTargetAltitude, 0) - 20000.0,
                              std::remainder(yaw - 1, 2 * M_PI),
                              target.at(kTargetSpeed, 0) - 1100.0};
    EXPECT_LE(std::abs(yaw), M_PI + kFloat32);
    for (int k = 0; k < 3; ++k) {
      least[k] = Smaller(least[k], change[k]);
      most[k] = Larger(most[k], change[k]);
    }
  }
  const double limit[3] = {3000, 3, 300};
  for (int k = 0; k < 3; ++k) {
    EXPECT_GE(least[k], -limit[k] * (1 + kEnds));
    EXPECT_LE(most[k], limit[k] * (1 + kEnds));
    EXPECT_LT(least[k], -limit[k] * 0.99);
    EXPECT_GT(most[k], limit[k] * 0.99);
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, HeadingTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& test) { return std::string(Name(test.param)); });

}  // namespace
}  // namespace skein
