// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "envs/env_config.h"

namespace skein {

/// Control steps of all agents together that are recorded at once; each takes up to 1300 bytes
/// until it is written.
inline constexpr int kMostRecordedSteps = 5000000;

/// The longest that an evaluation's flight in `env` can be, s.
double LongestFlight(const EnvConfig& env);

/// How many flights of up to `longest_s` by each of the agents have no more control steps than
/// kMostRecordedSteps.
int MostFlights(std::size_t agents, double longest_s, const EnvConfig& env);

/// Throws UsageError, which names what to `lower`, if so many flights of up to `longest_s` by each
/// of the agents could have more control steps than kMostRecordedSteps.
void RequireRoomFor(int flights, std::size_t agents, double longest_s, const EnvConfig& env,
                    const std::string& lower);

}  // namespace skein
