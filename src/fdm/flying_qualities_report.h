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

/// The names of classes ("I" to "IV") and categories ("A" to "C") of MIL-F-8785C.
std::vector<std::string> AirplaneClassNames();
std::vector<std::string> FlightPhaseCategoryNames();
/// The limits of such a class and category. Throws UsageError on another name.
LevelLimits LimitsNamed(const std::string& airplane_class, const std::string& category);

/// Throws UsageError of a turn or pull-up, and Error of a flight that is not steady, as for want of
/// thrust.
AssessedFlight AssessSteadyFlight(const Plant& plant, const SteadyFlightRequest& request,
                                  const LevelLimits& limits);

/// Every figure of one point, for people; `standard` says what its levels are of.
std::string Describe(const FlyingQualities& qualities, const std::string& standard);
/// Levels and least margins of several points, a line each.
std::string DescribeLevels(const std::vector<AssessedFlight>& flights);

nlohmann::ordered_json ToJson(const AssessedFlight& flight);

}  // namespace skein
