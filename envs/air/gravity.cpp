// SPDX-License-Identifier: Apache-2.0
#include "envs/air/gravity.h"

#include "envs/air/atmosphere_constants.h"

namespace skein {

double Gravity::At(double altitude_ft) const {
  if (!falls_with_altitude) return at_sea_level_ft_s2;
  const double distance = 1 + altitude_ft / kStandard1976.earth_radius_ft;  // earth radii
  return at_sea_level_ft_s2 / (distance * distance);
}

}  // namespace skein
