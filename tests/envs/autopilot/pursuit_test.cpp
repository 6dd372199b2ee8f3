// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "Eigen/Core"
#include "Eigen/Geometry"
#include "envs/autopilot/pursuit-inl.h"
#include "gtest/gtest.h"
#include "tests/tolerance.h"

namespace skein {
namespace HWY_NAMESPACE {
namespace {

constexpr double kDt = 0.02;
constexpr double kSpeed = 1000;

Kinematics<double> Moving(double ahead, double right, double up, double yaw_rate = 0) {
  Kinematics<double> motion = {};
  motion.ahead = ahead;
  motion.right = right;
  motion.up = up;
  motion.yaw_rate = yaw_rate;
  return motion;
}

TargetEstimate<double> At(double ahead, double right, double up) {
  TargetEstimate<double> target = {};
  target.ahead = ahead;
  target.right = right;
  target.up = up;
  return target;
}

constexpr Tolerance kRounding{1e-9, "float64 rounding of 1e4 ft"};
constexpr Tolerance kAccelerationRounding{1e-6, "float64 rounding of squares of speeds"};

TEST(Pursuit, FliesStraightToWhatLiesAhead) {
  const auto wanted = Pursue(PursuitGains(), Moving(900, 100, 300), At(9000, 1000, 3000));
  EXPECT_NEAR(wanted.lateral, 0, kRounding);
  EXPECT_NEAR(wanted.vertical, 0, kRounding);
}

TEST(Pursuit, TurnsTowardsTheTarget) {
  const auto right = Pursue(PursuitGains(), Moving(kSpeed, 0, 0), At(5000, 2000, 0));
  EXPECT_GT(right.lateral, 0);
  EXPECT_NEAR(right.vertical, 0, kRounding);
  const auto below = Pursue(PursuitGains(), Moving(kSpeed, 0, 0), At(5000, 0, -2000));
  EXPECT_NEAR(below.lateral, 0, kRounding);
  EXPECT_LT(below.vertical, 0);
}

/// 2 V^2 / L1 sin(eta), as hard as at 90 deg for what lies behind.
TEST(Pursuit, AcceleratesAsTheL1LawSays) {
  const PursuitGains gains;
  for (const double eta : {0.3, 1.0, 1.5, 2.0, 3.0}) {
    const auto wanted =
        Pursue(gains, Moving(kSpeed, 0, 0), At(4000 * std::cos(eta), 4000 * std::sin(eta), 0));
    const double sine = eta < M_PI / 2 ? std::sin(eta) : 1;
    EXPECT_NEAR(wanted.lateral, 2 * kSpeed * kSpeed / 4000 * sine, kAccelerationRounding) << eta;
  }
}

TEST(Pursuit, CorrectsNothingOnArrival) {
  const auto wanted = Pursue(PursuitGains(), Moving(kSpeed, 0, 0), At(200, 100, 0));
  EXPECT_EQ(wanted.lateral, 0);
  // Passed: turn back.
  EXPECT_GT(Pursue(PursuitGains(), Moving(kSpeed, 0, 0), At(-200, 100, 0)).lateral, 0);
}

/// A point mass that does what is wanted of it, anywhere around, passes within the tolerance of
/// the Tracking task.
TEST(Pursuit, PathsLeadToTheTarget) {
  for (const double azimuth : {0.0, 0.5, -1.0}) {
    for (const double elevation : {-0.5, 0.0, 0.5}) {
      Eigen::Vector3d position(0, 0, 0), velocity(kSpeed, 0, 0);
      const Eigen::Vector3d target =
          20000 * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      double nearest = 1e9;
      for (int step = 0; step < 1500; ++step) {
        const Eigen::Vector3d relative = target - position;
        nearest = std::min(nearest, relative.norm());
        const auto wanted = Pursue(PursuitGains(), Moving(velocity[0], velocity[1], velocity[2]),
                                   At(relative[0], relative[1], relative[2]));
        const Eigen::Vector3d forward = velocity.normalized();
        // Axes: north, east, up. The right of the velocity is level.
        const Eigen::Vector3d right = Eigen::Vector3d(-velocity[1], velocity[0], 0).normalized();
        const Eigen::Vector3d above = right.cross(forward) * -1;
        ASSERT_GT(above[2], 0);
        velocity += kDt * (wanted.lateral * right + wanted.vertical * above);
        velocity = kSpeed * velocity.normalized();
        position += kDt * velocity;
      }
      EXPECT_LT(nearest, 60) << azimuth << " " << elevation;
    }
  }
}

/// Heading axes turn under the aircraft; the estimate of a point at rest follows exactly where the
/// kinematics are exact, but for the Euler step.
TEST(TargetEstimate, FollowsThroughATurn) {
  constexpr Tolerance kEulerStep{5, "Euler steps of 0.02 s at 0.2 rad/s, ft of 8000"};
  constexpr double kYawRate = 0.2;
  const Eigen::Vector2d point(8000, 3000);
  TargetEstimate<double> target = {};
  Eigen::Vector2d position(0, 0);
  for (int step = 0; step <= 500; ++step) {
    const double yaw = kYawRate * kDt * step;
    const Eigen::Vector2d ahead(std::cos(yaw), std::sin(yaw)), right(-std::sin(yaw), std::cos(yaw));
    const Eigen::Vector2d relative = point - position;
    EstimateTarget(EstimatorGains(), kDt, Moving(kSpeed, 0, 0, kYawRate), relative.dot(ahead),
                   relative.dot(right), -500.0, step == 0, target);
    ASSERT_NEAR(target.ahead, relative.dot(ahead), kEulerStep) << step;
    ASSERT_NEAR(target.right, relative.dot(right), kEulerStep) << step;
    position += kDt * kSpeed * ahead;
  }
  EXPECT_NEAR(target.up, -500, kRounding);
}

TEST(TargetEstimate, FindsTheWindThroughATurn) {
  constexpr Tolerance kEulerWind{3, "Euler steps of 0.02 s at 0.1 rad/s, ft/s of 72"};
  constexpr double kYawRate = 0.1;
  const Eigen::Vector2d point(8000, 3000), wind(-40, 60);
  TargetEstimate<double> target = {};
  Eigen::Vector2d position(0, 0);
  Eigen::Vector2d ahead, right;
  for (int step = 0; step <= 1000; ++step) {
    const double yaw = kYawRate * kDt * step;
    ahead = {std::cos(yaw), std::sin(yaw)};
    right = {-std::sin(yaw), std::cos(yaw)};
    const Eigen::Vector2d relative = point - position;
    EstimateTarget(EstimatorGains(), kDt, Moving(kSpeed, 0, 0, kYawRate), relative.dot(ahead),
                   relative.dot(right), 0.0, step == 0, target);
    position += kDt * (kSpeed * ahead + wind);
  }
  EXPECT_NEAR(target.wind_ahead, wind.dot(ahead), kEulerWind);
  EXPECT_NEAR(target.wind_right, wind.dot(right), kEulerWind);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
