// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "envs/tuning/flying_qualities.h"
#include "src/fdm/steady_flight.h"

namespace skein {

/// The flying qualities at one point.
struct AssessedFlight {
  SteadyFlightRequest request;
  FlyingQualities qualities;
};

/// Every figure of one point, for people.
std::string Describe(const FlyingQualities& qualities);
/// Levels and least margins of several points, a line each.
std::string DescribeLevels(const std::vector<AssessedFlight>& flights);

nlohmann::ordered_json ToJson(const AssessedFlight& flight);

}  // namespace skein
