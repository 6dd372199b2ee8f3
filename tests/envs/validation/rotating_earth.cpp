// SPDX-License-Identifier: Apache-2.0
#include "tests/envs/validation/rotating_earth.h"

#include <cmath>

namespace skein::validation {
namespace {

constexpr double kGravitation_ft3_s2 = 3.986004418e14 / (0.3048 * 0.3048 * 0.3048);  // G M
constexpr double kSecondHarmonic = 1.08262982e-3;                                    // J2
constexpr double kEquatorialGravity_ft_s2 = 9.7803253359 / 0.3048;
constexpr double kSomigliana = 0.00193185265241;
constexpr double kEccentricitySquared = 6.69437999014e-3;
constexpr double kFlattening = 1 / 298.257223563;
constexpr double kCentrifugalRatio = 0.00344978650684;  // omega^2 a^2 b / (G M)

}  // namespace

double EquatorialGravity(double altitude_ft) {
  const double radius = wgs84::kEquatorialRadius_ft + altitude_ft;
  const double flatter = std::pow(wgs84::kEquatorialRadius_ft / radius, 2);
  return kGravitation_ft3_s2 / (radius * radius) * (1 + 1.5 * kSecondHarmonic * flatter) -
         wgs84::kRotation_rad_s * wgs84::kRotation_rad_s * radius;
}

double NormalGravity(double latitude_rad, double altitude_ft) {
  const double sine_squared = std::pow(std::sin(latitude_rad), 2);
  const double on_ellipsoid = kEquatorialGravity_ft_s2 * (1 + kSomigliana * sine_squared) /
                              std::sqrt(1 - kEccentricitySquared * sine_squared);
  const double height = altitude_ft / wgs84::kEquatorialRadius_ft;
  const double slope = 1 + kFlattening + kCentrifugalRatio - 2 * kFlattening * sine_squared;
  return on_ellipsoid * (1 - 2 * slope * height + 3 * height * height);
}

double GravityInLevelFlight(double latitude_rad, double altitude_ft, double north_ft_s,
                            double east_ft_s) {
  const double radius = wgs84::kEquatorialRadius_ft + altitude_ft;
  return NormalGravity(latitude_rad, altitude_ft) -
         2 * wgs84::kRotation_rad_s * east_ft_s * std::cos(latitude_rad) -
         (north_ft_s * north_ft_s + east_ft_s * east_ft_s) / radius;
}

}  // namespace skein::validation
