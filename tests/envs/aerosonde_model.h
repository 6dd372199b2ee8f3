// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/aircraft/derivative_aircraft_file.h"

namespace skein {

/// The Aerosonde's derivatives, as its file has them.
inline DerivativeAircraft AerosondeModel() {
  return ReadDerivativeAircraft("aerosonde", *AircraftFiles()[0].text);
}

}  // namespace skein
