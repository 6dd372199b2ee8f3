// SPDX-License-Identifier: Apache-2.0
#include "envs/state/attitude.h"

#include <algorithm>
#include <cmath>

namespace skein {

Eigen::Vector4d QuaternionFromEuler(const EulerAngles& angles) {
  const double cr = std::cos(angles.roll / 2), sr = std::sin(angles.roll / 2);
  const double cp = std::cos(angles.pitch / 2), sp = std::sin(angles.pitch / 2);
  const double cy = std::cos(angles.yaw / 2), sy = std::sin(angles.yaw / 2);
  return {cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
          cr * cp * sy - sr * sp * cy};
}

EulerAngles EulerFromQuaternion(const Eigen::Vector4d& quaternion) {
  const double q0 = quaternion[0], x = quaternion[1], y = quaternion[2], z = quaternion[3];
  return {std::atan2(2 * (q0 * x + y * z), 1 - 2 * (x * x + y * y)),
          std::asin(std::clamp(2 * (q0 * y - z * x), -1.0, 1.0)),
          std::atan2(2 * (q0 * z + x * y), 1 - 2 * (y * y + z * z))};
}

Eigen::Matrix3d BodyFromNed(const Eigen::Vector4d& quaternion) {
  const double q0 = quaternion[0], x = quaternion[1], y = quaternion[2], z = quaternion[3];
  Eigen::Matrix3d T;
  T << q0 * q0 + x * x - y * y - z * z, 2 * (x * y + q0 * z), 2 * (x * z - q0 * y),
      2 * (x * y - q0 * z), q0 * q0 - x * x + y * y - z * z, 2 * (y * z + q0 * x),
      2 * (x * z + q0 * y), 2 * (y * z - q0 * x), q0 * q0 - x * x - y * y + z * z;
  return T;
}

}  // namespace skein
