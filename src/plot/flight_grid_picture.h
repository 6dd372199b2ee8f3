// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "src/fdm/flight_grid.h"
#include "src/plot/picture.h"

namespace skein {

/// Where flight is steady, over speed and altitude: a cell for every point of the grid, shaded by
/// what could be climbed at full throttle; others by what ends flight there. Of a grid of two
/// altitudes and two speeds or more, which ascend.
Picture DrawFlightGrid(const FlownGrid& flown, double width, const std::string& title);

}  // namespace skein
