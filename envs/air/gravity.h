// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

/// Gravity of the published F-16 models, ft/s^2. Load factors are in multiples of it, whatever
/// gravity acts.
inline constexpr double kGravityFtS2 = 32.17;

/// Gravity, which acts along down.
struct Gravity {
  double at_sea_level_ft_s2 = kGravityFtS2;
  /// With the square of the distance from the earth's centre, as in the U.S. Standard Atmosphere
  /// 1976; false: it is the same at every altitude.
  bool falls_with_altitude = false;

  double At(double altitude_ft) const;  ///< ft/s^2, at an altitude in ft
};

}  // namespace skein
