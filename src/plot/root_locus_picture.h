// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "src/fdm/linearised_flight.h"
#include "src/plot/picture.h"

namespace skein {

/// The modes of the bare airframe in the complex plane, a dot for every flight, from pale for the
/// slowest to full for the fastest, of another shape for each of up to six altitudes: all at the
/// left, phugoid and spiral alone at the right.
Picture DrawRootLocus(const std::vector<LinearisedFlight>& flights, double width,
                      const std::string& title);

}  // namespace skein
