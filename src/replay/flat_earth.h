// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

/// Where the flat earth of the simulation touches the real one: above the runways of Edwards Air
/// Force Base, deg.
inline constexpr double kReferenceLatitude_deg = 34.9054, kReferenceLongitude_deg = -117.8837;

/// Degrees away from the reference.
struct GeographicOffset {
  double longitude_deg = 0, latitude_deg = 0;
};

/// North and east of the reference, m, laid along its meridian and its parallel with the radii of
/// curvature that WGS 84 has there. North stays north everywhere.
GeographicOffset GeographicOffsetOf(double north_m, double east_m);

}  // namespace skein
