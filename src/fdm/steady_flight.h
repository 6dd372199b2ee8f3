// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "envs/reference/trim.h"

namespace skein {

/// Steady flight as a user asks for it.
struct SteadyFlightRequest {
  double altitude_ft = 0;
  double true_airspeed_ft_s = 0;
  double flight_path_deg = 0;  ///< + in a climb
  double turn_rate_deg_s = 0;  ///< + to the right; the turn is coordinated
};

/// The steady flight that was found.
struct SteadyFlight {
  TrimPoint trim;
  PlantOutput output;  ///< of the equations of motion there
  /// Limits of the aircraft and its model that it exceeds, in words (src/fdm/trim_limits.h).
  std::vector<std::string> exceeded_limits;

  /// What describes it beside state, controls and engine power, by the names of files and of
  /// Python.
  std::array<std::pair<const char*, double>, 8> Numbers() const;
};

/// Throws Error where there is none; it says which limit is in the way, if one is.
SteadyFlight FindSteadyFlight(const Plant& plant, const SteadyFlightRequest& request);

}  // namespace skein
