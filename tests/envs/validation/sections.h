// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "envs/reference/plant.h"
#include "tests/envs/validation/figure.h"

namespace skein::validation {

/// Cases 1, 2, 3, 6, 7 and 8 of NASA/TM-2015-218675: bodies that fall from 30,000 ft over the
/// equator, flown by the float64 plant.
std::vector<Section> FallingBodies();

/// The brick of cases 2 and 3 over the equator, and how it begins to fall.
Plant Brick(bool damped);
RigidBodyState FallingBrick();

/// Cases 11 and 12 and the static shots of NASA/TM-2015-218675, by the F-16 of Stevens and Lewis,
/// which is theirs, and by Skein's.
std::vector<Section> PublishedF16Figures();

/// Case 13 of NASA/TM-2015-218675: the ends of its manoeuvres, and forces in them.
std::vector<Section> PublishedManoeuvres();

/// Trims of the University of Minnesota; trims and modes of Stevens and Lewis.
std::vector<Section> PublishedTrims();

/// The U.S. Standard Atmosphere 1976, and turbulence of MIL-F-8785C.
std::vector<Section> PublishedAirFigures();

}  // namespace skein::validation
