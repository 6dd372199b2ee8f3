// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "src/plot/picture.h"
#include "src/plot/recordings.h"

namespace skein {

struct TracksOptions {
  std::optional<double> interval_s;  ///< between two aircraft; without: as many as fit
  double width = 518;                ///< of the picture, points
  std::string title;
};

/// A map of flights, north up, equal scales, with targets, tolerances and a scale, and below it
/// their altitudes over time.
Picture TracksPicture(const Recordings& recordings, const TracksOptions& options);

}  // namespace skein
