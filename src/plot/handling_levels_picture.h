// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "src/fdm/flying_qualities_report.h"
#include "src/plot/picture.h"

namespace skein {

/// The equivalent short period against the boundaries of `limits` (MIL-F-8785C, 3.2.2.1): its
/// frequency over n/alpha and its damping over speed, a dot for every flight in the colour of its
/// altitude, from pale for the slowest to full for the fastest; and the worse of both levels over
/// speed and altitude. Unstable flights are in the last alone.
Picture DrawHandlingLevels(const std::vector<AssessedFlight>& flights, const LevelLimits& limits,
                           double width, const std::string& title);

}  // namespace skein
