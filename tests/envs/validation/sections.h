// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tests/envs/validation/figure.h"

namespace skein::validation {

/// Cases 1, 2, 3, 6, 7 and 8 of NASA/TM-2015-218675: bodies that fall from 30,000 ft over the
/// equator, flown by the float64 plant.
std::vector<Section> FallingBodies();

/// The F-16: cases 11 and 12 and the static shots of NASA/TM-2015-218675, trims of the University
/// of Minnesota and of Stevens and Lewis, modes.
std::vector<Section> PublishedF16Figures();

/// The U.S. Standard Atmosphere 1976, and turbulence of MIL-F-8785C.
std::vector<Section> PublishedAirFigures();

}  // namespace skein::validation
