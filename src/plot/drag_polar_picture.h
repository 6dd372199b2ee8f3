// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "src/fdm/flight_grid.h"
#include "src/plot/picture.h"

namespace skein {

/// Drag polars of trimmed flight: lift over drag coefficient at every altitude, speed by speed,
/// with a dot where lift over drag is greatest. Flight that lacks thrust is part of them; flight
/// that is not in balance, or has alpha outside the tables, is not. Of a grid of two speeds or
/// more.
Picture DrawDragPolars(const FlownGrid& flown, double width, const std::string& title);

}  // namespace skein
