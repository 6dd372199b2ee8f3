#pragma once

namespace skein {

/// What observations are divided by (NeuralPlane's public configuration), in foot and second.
inline constexpr double kFeetPerMetre = 1 / 0.3048;
inline constexpr double kAltitudeErrorUnitFt = 1000 * kFeetPerMetre;
inline constexpr double kAltitudeUnitFt = 5000 * kFeetPerMetre;
inline constexpr double kSpeedUnitFtS = 340 * kFeetPerMetre;
inline constexpr double kPowerUnit = 100;

}  // namespace skein
