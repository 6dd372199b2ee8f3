// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "envs/aircraft/aircraft.h"

namespace skein {

/// Names that EnvConfig::aircraft may have.
std::vector<std::string> AircraftNames();

/// The aircraft of that name as its data give it. Throws Error on an unknown name; the message
/// lists the known ones.
Aircraft LoadAircraft(const std::string& name);

}  // namespace skein
