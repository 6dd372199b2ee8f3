// SPDX-License-Identifier: Apache-2.0
#include "envs/state/attitude.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kRounding{1e-13, "float64 rounding"};
constexpr Tolerance kAngles{1e-11, "float64 rounding, near the pitch of the pole"};

TEST(Attitude, EulerAnglesSurviveTheRoundTrip) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int n = 0; n < 200; ++n) {
    const EulerAngles angles{3.1 * unit(random), 1.5 * unit(random), 3.1 * unit(random)};
    const EulerAngles back = EulerFromQuaternion(QuaternionFromEuler(angles));
    EXPECT_NEAR(back.roll, angles.roll, kAngles);
    EXPECT_NEAR(back.pitch, angles.pitch, kAngles);
    EXPECT_NEAR(back.yaw, angles.yaw, kAngles);
  }
}

TEST(Attitude, MatrixIsTheRotationByYawThenPitchThenRoll) {
  const EulerAngles angles{0.4, -0.7, 2.1};
  const Eigen::Matrix3d ned_from_body = (Eigen::AngleAxisd(angles.yaw, Eigen::Vector3d::UnitZ()) *
                                         Eigen::AngleAxisd(angles.pitch, Eigen::Vector3d::UnitY()) *
                                         Eigen::AngleAxisd(angles.roll, Eigen::Vector3d::UnitX()))
                                            .toRotationMatrix();
  EXPECT_LT((BodyFromNed(QuaternionFromEuler(angles)) - ned_from_body.transpose()).norm(),
            kRounding);
}

TEST(Attitude, GravityPullsTheRaisedNoseBackAndTheLoweredWingDown) {
  const Eigen::Vector3d down(0, 0, 1);
  EXPECT_LT((BodyFromNed(QuaternionFromEuler({0, 0.3, 0})) * down).x(), 0);
  EXPECT_GT((BodyFromNed(QuaternionFromEuler({0.3, 0, 0})) * down).y(), 0);
}

}  // namespace
}  // namespace skein
