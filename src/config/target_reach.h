// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "envs/env_config.h"

namespace skein {

/// What flights are given to fly to in the place of what is drawn, by the columns of their files:
/// altitude_ft, true_airspeed_fps, mach.
using GivenTargets = std::map<std::string, double>;

/// A line for every target, of a task file or, in a built-in task, of what is `given`, that is an
/// angle of more than a turn, or that no flight can come to, for all that is drawn of it lies
/// beyond where flights end: altitudes below env.termination.min_altitude_ft, airspeeds and Mach
/// numbers out of min_mach to max_mach. What else makes a target too high or too fast, it does not
/// know. What is `given` is judged as all that is drawn. Of a task file's own ends it knows those
/// of a target that is drawn between two values, as long as nothing is given in its place, raises
/// or wraps it.
std::vector<std::string> TargetsBeyondLimits(const EnvConfig& env, const GivenTargets& given = {});

/// A line if flights may begin above the engine's tables of the aircraft, and one for every target
/// of altitude, or point, that may be drawn, or is `given`, above them; thrust is held there at
/// what it is at their end. Of the tables' lower end nothing is said. Points are taken for drawn
/// around the horizon, and later targets of a mission for its first. A given altitude is the first
/// target's. Throws Error on an unknown aircraft.
std::vector<std::string> AltitudesBeyondTables(const EnvConfig& env,
                                               const GivenTargets& given = {});

/// A line for every end of a task file beyond which all flights begin, of altitude and airspeed.
std::vector<std::string> StartsBeyondOwnEnds(const EnvConfig& env);

/// A line if the strongest steady wind, met as a step, is no weaker than the slowest flight begins:
/// from behind it leaves no air ahead.
std::vector<std::string> WindsBeyondAirspeed(const EnvConfig& env);

}  // namespace skein
