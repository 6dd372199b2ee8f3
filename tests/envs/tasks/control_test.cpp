// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/control.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
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

constexpr Tolerance kFloat32{3e-6, "float32 rounding of radians and of units of 340 m/s"};
constexpr Tolerance kEnds{1e-5, "float32 rounding at the ends of a range"};
constexpr double kSpeedUnit = 340 / 0.3048;

/// Reference in float64: the angle of the rotation between two attitudes, by their matrices.
double AngleBetween(const EulerAngles& a, const EulerAngles& b) {
  const Eigen::Matrix3d rotation =
      BodyFromNed(QuaternionFromEuler(a)) * BodyFromNed(QuaternionFromEuler(b)).transpose();
  return Eigen::AngleAxisd(rotation).angle();
}

class ControlTest : public testing::TestWithParam<simd::Target> {
 protected:
  static EnvConfig ConfigOf(double speed_error_weight, bool reward_includes_roll = true) {
    EnvConfig config;
    config.task = "control";
    config.control.reward_includes_roll = reward_includes_roll;
    config.control.speed_error_weight = speed_error_weight;
    return config;
  }

  /// Towards `attitude` at 1000 ft/s, 600 of them along the z axis.
  void SetFlight(int i, const EulerAngles& attitude) {
    const Eigen::Vector4d q = QuaternionFromEuler(attitude);
    for (int k = 0; k < 4; ++k) flight_.at(kQ0 + k, i) = static_cast<float>(q[k]);
    flight_.at(kDown, i) = -20000;
    flight_.at(kU, i) = 800;
    flight_.at(kW, i) = 600;
  }
  /// Draws targets from a range of no width around the wanted ones.
  void SetTarget(int i, double pitch, double yaw, double speed_ft_s) {
    EnvConfig config = ConfigOf(0);
    config.control.pitch_change_rad = config.control.yaw_change_rad =
        config.control.speed_change_fps = 0;
    simd::RandomStream random({1, 0, 0, 0, simd::RandomPurpose::kTarget});
    MakeTask(config)->Reset({20000, speed_ft_s, pitch, yaw}, &random, targets_.tile(), i);
  }
  std::vector<float> Errors() {
    std::vector<float> errors(kNumTaskErrors * flight_.stride());
    task_->Errors(flight_.tile(), targets_.tile(), errors.data(), flight_.stride());
    return errors;
  }
  void RewardBy(const Task& task) {
    task.ComputeReward(flight_.tile(), targets_.tile(), steps_.data(),
                       {reward_.data(), reached_.data()});
  }

  static constexpr int kCount = 37;
  ScopedTarget target_{GetParam()};
  std::unique_ptr<Task> task_ = MakeTask(ConfigOf(5));
  std::unique_ptr<Task> angle_only_ = MakeTask(ConfigOf(0));
  std::unique_ptr<Task> nose_only_ = MakeTask(ConfigOf(0, false));
  TestTile flight_{kCount};
  TestTile targets_{kCount, kNumControlColumns};
  std::vector<float> reward_ = std::vector<float>(flight_.stride());
  std::vector<std::int32_t> reached_ = std::vector<std::int32_t>(flight_.stride());
  std::vector<std::int32_t> steps_ = std::vector<std::int32_t>(flight_.stride());
};

TEST_P(ControlTest, ErrorsAreTargetMinusActualInTheirUnits) {
  for (int i = 0; i < kCount; ++i) {
    SetFlight(i, {0.02 * i, 0.3, 0.5});
    SetTarget(i, 0.3 - 0.7, 0.5 + 0.4, 1000 - 0.1 * kSpeedUnit);
  }
  const std::vector<float> errors = Errors();
  for (int i = 0; i < kCount; ++i) {
    const auto index = static_cast<std::size_t>(i);
    EXPECT_NEAR(errors[index], -0.7, kFloat32);
    EXPECT_NEAR(errors[flight_.stride() + index], 0.4, kFloat32);
    EXPECT_NEAR(errors[2 * flight_.stride() + index], -0.1, kFloat32);
  }
  const std::vector<TargetQuantity> quantities = task_->target_quantities();
  EXPECT_DOUBLE_EQ(quantities[0].error_unit, kDegPerRad);
  EXPECT_DOUBLE_EQ(quantities[1].error_unit, kDegPerRad);
  EXPECT_DOUBLE_EQ(quantities[2].error_unit, kSpeedUnit);
}

TEST_P(ControlTest, PitchErrorHoldsUpToTheVerticalAndUpsideDown) {
  // The arc sine of a float32 sine would be wrong by 3e-4 here.
  const double pitch_deg[] = {0, 30, 60, 85, 89, 89.9, 90, -89.9, -90, -45};
  int i = 0;
  for (const double pitch : pitch_deg) {
    SetFlight(i, {0, pitch / kDegPerRad, 2});
    SetTarget(i++, 0, 2, 1000);
    SetFlight(i, {M_PI, pitch / kDegPerRad, 2});
    SetTarget(i++, 0, 2, 1000);
  }
  const std::vector<float> errors = Errors();
  for (int k = 0; k < i; ++k) {
    EXPECT_NEAR(errors[static_cast<std::size_t>(k)], -pitch_deg[k / 2] / kDegPerRad, kFloat32) << k;
  }
}

TEST_P(ControlTest, YawErrorTakesTheShortWayRound) {
  constexpr double kStep = 0.17;
  for (int i = 0; i < kCount; ++i) {
    SetFlight(i, {0.3, -0.2, std::remainder(kStep * i, 2 * M_PI)});
    SetTarget(i, 0.1, std::remainder(-2.3 * kStep * i, 2 * M_PI), 900);
  }
  const std::vector<float> errors = Errors();
  for (int i = 0; i < kCount; ++i) {
    const double expected = std::remainder(-3.3 * kStep * i, 2 * M_PI);
    const double actual = errors[flight_.stride() + static_cast<std::size_t>(i)];
    EXPECT_LE(std::abs(actual), M_PI + kFloat32);
    EXPECT_NEAR(std::remainder(actual - expected, 2 * M_PI), 0, kFloat32) << i;
  }
}

TEST_P(ControlTest, RewardIsMinusTheAngleToTheTargetAttitude) {
  struct Case {
    EulerAngles attitude;
    double target_pitch, target_yaw, angle;
  };
  const std::vector<Case> cases = {
      {{0, 0.3, 1}, 0.3, 1, 0},            // there
      {{0, 0.3, 1}, -0.1, 1, 0.4},         // by pitch alone
      {{0, 0, 1}, 0, -0.5, 1.5},           // by yaw alone, level
      {{0.8, 0, 1}, 0, 1, 0.8},            // by roll alone: the target's is 0
      {{-0.8, 0.6, 1}, 0.6, 1, 0.8},       // the same, nose up
      {{M_PI, 0, 0}, 0, 0, M_PI},          // upside down
      {{0, 0, 3}, 0, -3, 2 * M_PI - 6},    // the short way round
      {{0, 0, 0}, M_PI / 2, 0, M_PI / 2},  // straight up
      // ... and yawed by 2 rad: the scalar part is cos(45 deg) cos(1 rad).
      {{0, 0, 0}, M_PI / 2, 2, 2 * std::acos(std::sqrt(0.5) * std::cos(1.0))},
      {{0, 0, 0}, 0, 1e-3, 1e-3},    // small, where an arc cosine has no digits
      {{0, 1.5, 0}, 1.5, 0.1, 0.1},  // a yaw about the vertical, nose up
  };
  for (int i = 0; i < static_cast<int>(cases.size()); ++i) {
    const Case& c = cases[static_cast<std::size_t>(i)];
    SetFlight(i, c.attitude);
    SetTarget(i, c.target_pitch, c.target_yaw, 1000);
  }
  RewardBy(*angle_only_);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    EXPECT_NEAR(reward_[i], -cases[i].angle, kFloat32) << "case " << i;
  }
}

TEST_P(ControlTest, RewardAgreesWithRotationMatricesInFloat64) {
  simd::RandomStream random({3, 1, 4, 1, simd::RandomPurpose::kTarget});
  for (int round = 0; round < 20; ++round) {
    std::vector<double> angles;
    for (int i = 0; i < kCount; ++i) {
      const EulerAngles attitude{random.Uniform(-M_PI, M_PI), random.Uniform(-1.57, 1.57),
                                 random.Uniform(-M_PI, M_PI)};
      const EulerAngles target{0, random.Uniform(-1.57, 1.57), random.Uniform(-M_PI, M_PI)};
      SetFlight(i, attitude);
      // The other quaternion of the same attitude must not matter.
      if (i % 2 == 1) {
        for (int k = 0; k < 4; ++k) flight_.at(kQ0 + k, i) = -flight_.at(kQ0 + k, i);
      }
      SetTarget(i, target.pitch, target.yaw, 1000);
      angles.push_back(AngleBetween(attitude, target));
    }
    RewardBy(*angle_only_);
    for (std::size_t i = 0; i < kCount; ++i) EXPECT_NEAR(reward_[i], -angles[i], kFloat32) << i;
  }
}

TEST_P(ControlTest, RewardCanBeMinusTheAngleOfTheNoseAtAnyRoll) {
  for (int i = 0; i < kCount; ++i) {
    SetFlight(i, {0.17 * i, std::asin(std::sin(0.4 * i)), std::remainder(0.9 * i, 2 * M_PI)});
    SetTarget(i, std::asin(std::sin(1.3 * i)), std::remainder(-0.5 * i, 2 * M_PI), 1000);
  }
  // Target and nose in one, the other way round, and apart by less than float32 sees in a cosine.
  SetFlight(0, {2, 0.3, 1});
  SetTarget(0, 0.3, 1, 1000);
  SetFlight(1, {2, 0.3, 1});
  SetTarget(1, -0.3, 1 - M_PI, 1000);
  SetFlight(2, {-1, 0.3, 1});
  SetTarget(2, 0.3 + 1e-4, 1, 1000);
  RewardBy(*nose_only_);
  const auto direction = [](double pitch, double yaw) {
    return Eigen::Vector3d(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw),
                           -std::sin(pitch));
  };
  for (int i = 3; i < kCount; ++i) {
    const Eigen::Vector3d nose =
        direction(std::asin(std::sin(0.4 * i)), std::remainder(0.9 * i, 2 * M_PI));
    const Eigen::Vector3d wanted =
        direction(std::asin(std::sin(1.3 * i)), std::remainder(-0.5 * i, 2 * M_PI));
    const double angle = std::atan2(nose.cross(wanted).norm(), nose.dot(wanted));
    EXPECT_NEAR(reward_[static_cast<std::size_t>(i)], -angle, kFloat32) << i;
  }
  EXPECT_NEAR(reward_[0], 0, kFloat32);
  EXPECT_NEAR(reward_[1], -M_PI, kFloat32);
  EXPECT_NEAR(reward_[2], -1e-4, kFloat32);
}

TEST_P(ControlTest, SpeedErrorsCostTheirWeightOnEitherSide) {
  SetFlight(0, {0, 0.2, 1});
  SetTarget(0, -0.1, 1, 1000 + 0.2 * kSpeedUnit);
  SetFlight(1, {0, 0.2, 1});
  SetTarget(1, -0.1, 1, 1000 - 0.2 * kSpeedUnit);
  RewardBy(*task_);
  EXPECT_NEAR(reward_[0], -(0.3 + 5 * 0.2), kFloat32);
  EXPECT_NEAR(reward_[1], -(0.3 + 5 * 0.2), kFloat32);
  RewardBy(*angle_only_);
  EXPECT_NEAR(reward_[0], -0.3, kFloat32);
}

TEST_P(ControlTest, EitherAngleCostsItsWeight) {
  for (const bool reward_includes_roll : {false, true}) {
    EnvConfig config = ConfigOf(5, reward_includes_roll);
    config.control.angle_error_weight = 2;
    SetFlight(0, {0, 0.2, 1});
    SetTarget(0, -0.1, 1, 1000 + 0.2 * kSpeedUnit);
    RewardBy(*MakeTask(config));
    EXPECT_NEAR(reward_[0], -(2 * 0.3 + 5 * 0.2), kFloat32);
  }
}

TEST_P(ControlTest, MirroredFlightsGetTheSameReward) {
  for (const int side : {0, 1}) {
    const double sign = side == 0 ? 1 : -1;
    SetFlight(side, {sign * 0.7, 0.4, sign * 0.8});
    SetTarget(side, -0.3, sign * -1.1, 1100);
  }
  RewardBy(*task_);
  EXPECT_NEAR(reward_[0], reward_[1], kFloat32);
}

TEST_P(ControlTest, IsReachedOnlyInsideAllTolerancesAtAnyRollAndTime) {
  struct Case {
    double roll_deg, pitch_deg, yaw_deg, speed_ft_s;
    int steps_before;
    bool reached;
  };
  const std::vector<Case> cases = {
      {0, 4.9, 4.9, 19, 1000, true}, {0, -4.9, -4.9, -19, 1000, true},
      {0, 5.1, 0, 0, 1000, false},   {0, -5.1, 0, 0, 1000, false},
      {0, 0, 5.1, 0, 1000, false},   {0, 0, -5.1, 0, 1000, false},
      {0, 0, 0, 21, 1000, false},    {0, 0, 0, -21, 1000, false},
      {75, 0, 0, 0, 1000, true},     {-170, 0, 0, 0, 1000, true},
      {0, 0, 0, 0, 0, true},
  };
  for (int i = 0; i < static_cast<int>(cases.size()); ++i) {
    const Case& c = cases[static_cast<std::size_t>(i)];
    SetFlight(i, {c.roll_deg / kDegPerRad, 0.3, 3.1});
    SetTarget(i, 0.3 + c.pitch_deg / kDegPerRad,
              std::remainder(3.1 + c.yaw_deg / kDegPerRad, 2 * M_PI), 1000 + c.speed_ft_s);
    steps_[static_cast<std::size_t>(i)] = c.steps_before;
  }
  RewardBy(*task_);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    EXPECT_EQ(reached_[i], cases[i].reached ? 1 : 0) << "case " << i;
  }
}

TEST_P(ControlTest, TolerancesAreTheConfigurations) {
  EnvConfig config = ConfigOf(0);
  config.control.pitch_tolerance_deg = 1;
  config.control.yaw_tolerance_deg = 2;
  config.control.speed_tolerance_fps = 3;
  const std::unique_ptr<Task> strict = MakeTask(config);
  const double errors[][3] = {{0.9, 1.9, 2.9}, {1.1, 0, 0}, {0, 2.1, 0}, {0, 0, 3.1}};
  for (int i = 0; i < 4; ++i) {
    SetFlight(i, {0, 0.1, 0.2});
    SetTarget(i, 0.1 + errors[i][0] / kDegPerRad, 0.2 + errors[i][1] / kDegPerRad,
              1000 + errors[i][2]);
  }
  RewardBy(*strict);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(reached_[i], i == 0 ? 1 : 0) << i;
}

TEST_P(ControlTest, TrainingTolerancesAreSharesDrawnByEpisode) {
  EnvConfig config = ConfigOf(0);
  config.control.pitch_change_rad = config.control.yaw_change_rad =
      config.control.speed_change_fps = 0;
  config.control.training_tolerance_min = 0.2;
  const std::unique_ptr<Task> training = MakeTask(config);
  double least = 1, most = 0, mean = 0;
  constexpr int kEpisodes = 2000;
  for (std::uint32_t episode = 0; episode < kEpisodes; ++episode) {
    simd::RandomStream random({5, 0, episode, 0, simd::RandomPurpose::kTarget});
    training->Reset({20000, 1000, 0.1, 0.2}, &random, targets_.tile(), 0);
    const double share = targets_.at(kControlTolerance, 0);
    least = std::min(least, share);
    most = std::max(most, share);
    mean += share / kEpisodes;
    // 3 deg of pitch are 0.6 of the tolerance.
    SetFlight(0, {0, 0.1 - 3 / kDegPerRad, 0.2});
    RewardBy(*training);
    EXPECT_EQ(reached_[0], share > 0.6 ? 1 : 0) << share;
  }
  EXPECT_GE(least, 0.2);
  EXPECT_LT(least, 0.21);
  EXPECT_GT(most, 0.99);
  EXPECT_NEAR(mean, 0.6, kStandardErrors * 0.4 / std::sqrt(12.0 * kEpisodes));
  EXPECT_EQ(EvaluationConfig(config).control.training_tolerance_min, 1);
}

TEST_P(ControlTest, AStateThatIsNotFiniteIsNotReached) {
  SetFlight(0, {0, 0.1, 0.2});
  SetTarget(0, 0.1, 0.2, 1000);
  for (const int column : {kU, kW, kQ0, kQy}) {
    SetFlight(0, {0, 0.1, 0.2});
    flight_.at(column, 0) = std::nanf("");
    RewardBy(*task_);
    EXPECT_EQ(reached_[0], 0) << column;
  }
}

TEST_P(ControlTest, TargetsAreDrawnAroundTheStart) {
  double least[3] = {1e9, 1e9, 1e9}, most[3] = {-1e9, -1e9, -1e9};
  for (std::uint32_t episode = 0; episode < 2000; ++episode) {
    simd::RandomStream random({5, 0, episode, 0, simd::RandomPurpose::kTarget});
    TestTile target(1, kNumControlColumns);
    task_->Reset({20000, 1100, 0.05, 1}, &random, target.tile(), 0);
    const double yaw = target.at(kControlYaw, 0);
    const double change[3] = {target.at(kControlPitch, 0) - 0.05, std::remainder(yaw - 1, 2 * M_PI),
                              target.at(kControlSpeed, 0) - 1100.0};
    EXPECT_LE(std::abs(yaw), M_PI + kFloat32);
    for (int k = 0; k < 3; ++k) {
      least[k] = Smaller(least[k], change[k]);
      most[k] = Larger(most[k], change[k]);
    }
  }
  const double limit[3] = {0.5, 3, 300};
  for (int k = 0; k < 3; ++k) {
    EXPECT_GE(least[k], -limit[k] * (1 + kEnds));
    EXPECT_LE(most[k], limit[k] * (1 + kEnds));
    EXPECT_LT(least[k], -limit[k] * 0.99);
    EXPECT_GT(most[k], limit[k] * 0.99);
  }
}

TEST_P(ControlTest, PitchTargetsBeyondTheVerticalAreFoldedBack) {
  EnvConfig config = ConfigOf(0);
  config.control.pitch_change_rad = 3;
  const std::unique_ptr<Task> wide = MakeTask(config);
  double least = 0, most = 0;
  for (std::uint32_t episode = 0; episode < 2000; ++episode) {
    const simd::RandomKey key{5, 0, episode, 0, simd::RandomPurpose::kTarget};
    simd::RandomStream random(key), same(key);
    TestTile target(1, kNumControlColumns);
    wide->Reset({20000, 1100, 0.05, 0}, &random, target.tile(), 0);
    const double drawn = 0.05 + same.Uniform(-3, 3);
    const double folded = drawn > M_PI / 2    ? M_PI - drawn
                          : drawn < -M_PI / 2 ? -M_PI - drawn
                                              : drawn;
    EXPECT_NEAR(target.at(kControlPitch, 0), folded, kFloat32);
    least = std::min(least, folded);
    most = std::max(most, folded);
  }
  EXPECT_LT(least, -1.5);
  EXPECT_GT(most, 1.5);
}

INSTANTIATE_TEST_SUITE_P(Targets, ControlTest, testing::ValuesIn(simd::SupportedTargets()),
                         [](const auto& test) { return std::string(Name(test.param)); });

}  // namespace
}  // namespace skein
