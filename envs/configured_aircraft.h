// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/aircraft/aircraft.h"
#include "envs/env_config.h"

namespace skein {

/// The nominal aircraft of an environment, as its configuration has it. Throws Error on an unknown
/// one, and on effects of the Mach number for which it has no data.
Aircraft ConfiguredAircraft(const EnvConfig& config);

}  // namespace skein
