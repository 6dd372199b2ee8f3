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
};

/// Flights in space over a grid: the first agent's with aircraft and the sweep of their wings, the
/// others' as lines; with targets, tolerances, shadows, altitudes and north. Equal scales.
Picture SpacePicture(const Recordings& recordings, const SpaceOptions& options);

}  // namespace skein
