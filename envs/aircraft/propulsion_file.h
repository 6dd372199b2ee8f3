// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/aircraft/aircraft_json.h"
#include "envs/aircraft/derivative_aircraft.h"

namespace skein {

/// Reads the section `propulsion`, whose key `kind` says what is in it: electric (also without the
/// key), piston or jet. Throws Error as Section does.
void ReadPropulsion(Section section, DerivativeAircraft* aircraft);

}  // namespace skein
