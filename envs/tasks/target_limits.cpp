// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/target_limits.h"

#include <algorithm>

namespace skein {

double TargetLimits::Altitude(double drawn_ft) const {
  return min_altitude_ft > 0 ? std::max(drawn_ft, min_altitude_ft) : drawn_ft;
}

double TargetLimits::TrueAirspeed(double drawn_ft_s, double altitude_ft) const {
  if (min_mach == 0) return drawn_ft_s;
  return std::max(drawn_ft_s, min_mach * AirAt(atmosphere, altitude_ft).sound_speed_ft_s);
}

}  // namespace skein
