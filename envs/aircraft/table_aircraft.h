// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "envs/aircraft/aircraft.h"

namespace skein {

/// Reads the text of a file of model "tables": coefficients by alpha, sideslip and elevator, thrust
/// by altitude and Mach number, with or without a leading-edge flap
/// (docs/reference/aircraft-files.md). A table that is given on fewer axes than it may have is
/// constant along the others. Throws Error that names the aircraft and the key.
Aircraft ReadTableAircraft(const std::string& name, std::string_view text);

}  // namespace skein
