// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/air/atmosphere.h"

namespace skein {

/// The least that targets may be: those drawn below are raised to it.
struct TargetLimits {
  double min_mach = 0;  ///< of true airspeeds, by the speed of sound at the target's altitude
  double min_altitude_ft = 0;  ///< 0 for both: as drawn
  AtmosphereModel atmosphere = AtmosphereModel::kStevensLewis;

  double Altitude(double drawn_ft) const;
  /// At `altitude_ft`, the target's, or the start's where a target has none.
  double TrueAirspeed(double drawn_ft_s, double altitude_ft) const;
};

}  // namespace skein
