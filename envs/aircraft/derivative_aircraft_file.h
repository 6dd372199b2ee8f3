// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "envs/aircraft/derivative_aircraft.h"

namespace skein {

/// A file data/NAME/aircraft.json, embedded in the library. docs/how-to/add-an-aircraft.md says
/// what is in it.
struct AircraftFile {
  const char* name;
  const std::string_view* text;
};

/// All of them, by name.
const std::vector<AircraftFile>& AircraftFiles();

/// Whether the file must have the gains of flight control. Where it has none and need not, they
/// stay the defaults, which are another aircraft's: `skein aircraft tune` replaces them.
enum class FlightControlSection { kRequired, kOptional };

/// Reads the text of such a file. Throws Error that names the aircraft and the key of what is
/// missing, unknown, not a number, or one that cannot be flown with, such as a mass of zero.
DerivativeAircraft ReadDerivativeAircraft(
    const std::string& name, std::string_view text,
    FlightControlSection flight_control = FlightControlSection::kRequired);

}  // namespace skein
