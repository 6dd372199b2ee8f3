// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/aircraft/units.h"

namespace skein {

/// ReferenceUnits of the F-16 (NeuralPlane's public configuration: 1 km, 5 km, 340 m/s), for what
/// flies it alone.
inline constexpr double kAltitudeErrorUnitFt = 1000 * kFeetPerMetre;
inline constexpr double kAltitudeUnitFt = 5000 * kFeetPerMetre;
inline constexpr double kSpeedUnitFtS = 340 * kFeetPerMetre;

}  // namespace skein
