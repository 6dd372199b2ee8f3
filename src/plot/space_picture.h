// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "src/plot/picture.h"
#include "src/plot/recordings.h"

namespace skein {

struct SpaceOptions {
  double azimuth_deg = 25, elevation_deg = 28;  ///< where the view looks: compass direction, down
  std::optional<double> interval_s;             ///< between two aircraft; without: as many as fit
  double width = 518;                           ///< of the picture, points
  std::string title;
  /// How many times as high as at equal scales altitudes are drawn; without: DefaultVerticalScale
  /// of what was flown.
  std::optional<double> vertical_scale = std::nullopt;
};

/// 1 where altitudes extend over a tenth of the horizontal extent or more, or over nothing; else
/// the power of two from 2 to 32 that brings them nearest to a fifth of it.
double DefaultVerticalScale(double altitude_extent_ft, double horizontal_extent_ft);

/// Flights in space over a grid: the first agent's with aircraft and the sweep of their wings, the
/// others' as lines; with targets, tolerances, shadows, altitudes and north. Scales are
/// equal but for the vertical one, of which the legend says how many times it is enlarged.
Picture SpacePicture(const Recordings& recordings, const SpaceOptions& options);

}  // namespace skein
