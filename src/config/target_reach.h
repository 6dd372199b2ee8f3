// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "envs/env_config.h"

namespace skein {

/// A line for every target of a task file that no flight can come to, for all that is drawn of it
/// lies beyond where flights end: altitudes below env.termination.min_altitude_ft, airspeeds and
/// Mach numbers out of min_mach to max_mach. What else makes a target too high or too fast, it does
/// not know.
std::vector<std::string> TargetsBeyondLimits(const EnvConfig& env);

}  // namespace skein
