// SPDX-License-Identifier: Apache-2.0
#include "src/replay/flat_earth.h"

#include <cmath>

#include "envs/aircraft/aircraft.h"

namespace skein {
namespace {

/// Semi-major axis, m, and first eccentricity squared of WGS 84.
constexpr double kSemiMajorAxis_m = 6378137, kEccentricitySquared = 6.69437999014e-3;

}  // namespace

GeographicOffset GeographicOffsetOf(double north_m, double east_m) {
  const double latitude = kReferenceLatitude_deg / kDegPerRad;
  const double w = 1 - kEccentricitySquared * std::sin(latitude) * std::sin(latitude);
  const double prime_vertical = kSemiMajorAxis_m / std::sqrt(w);
  const double meridian = prime_vertical * (1 - kEccentricitySquared) / w;
  return {east_m / (prime_vertical * std::cos(latitude)) * kDegPerRad,
          north_m / meridian * kDegPerRad};
}

}  // namespace skein
