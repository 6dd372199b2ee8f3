// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein::validation {

/// World Geodetic System 1984.
namespace wgs84 {
inline constexpr double kRotation_rad_s = 7.292115e-5;
inline constexpr double kEquatorialRadius_ft = 6378137 / 0.3048;
}  // namespace wgs84

/// Gravity on the rotating earth over the equator, ft/s^2: gravitation with its second harmonic,
/// as the check cases have it, less the centrifugal acceleration.
double EquatorialGravity(double altitude_ft);

/// Normal gravity of WGS-84 at a latitude and altitude, ft/s^2: gravitation less the centrifugal
/// acceleration of what rests on the rotating earth (NIMA TR8350.2, equations 4-1 and 4-3).
double NormalGravity(double latitude_rad, double altitude_ft);

/// The acceleration that a wing must hold up in level flight over the rotating, round earth,
/// ft/s^2: normal gravity less what the way around the earth and its rotation take off
/// (Eotvos). Speeds over ground, ft/s.
double GravityInLevelFlight(double latitude_rad, double altitude_ft, double north_ft_s,
                            double east_ft_s);

}  // namespace skein::validation
