// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace skein {

/// Roll, pitch and yaw, rad: the aircraft's axes are reached from north, east, down by yaw, then
/// pitch, then roll.
struct EulerAngles {
  double roll = 0, pitch = 0, yaw = 0;
};

/// Quaternion (q0, qx, qy, qz) of an attitude; q0 >= 0 for small angles.
Eigen::Vector4d QuaternionFromEuler(const EulerAngles& angles);

/// Roll and yaw in (-pi, pi], pitch in [-pi/2, pi/2], of a unit quaternion.
EulerAngles EulerFromQuaternion(const Eigen::Vector4d& quaternion);

/// The matrix T of v_body = T v_ned (equation 3 of the NeuralPlane paper).
Eigen::Matrix3d BodyFromNed(const Eigen::Vector4d& quaternion);

}  // namespace skein
