// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "envs/aircraft/derivative_aircraft.h"
#include "envs/reference/plant.h"
#include "envs/tuning/flight_envelope.h"
#include "envs/tuning/gain_tuning.h"
#include "envs/tuning/handling.h"

namespace skein {

/// Something that a check of an aircraft has to say.
struct Finding {
  enum Kind {
    kError,    ///< cannot be, or cannot be flown
    kWarning,  ///< unusual: often a sign, a unit or a reference length
  };
  Kind kind = kWarning;
  std::string text;
};

/// Of the airframe of a model of tables: ratios of mass and lengths.
std::vector<Finding> CheckAirframe(const Airframe& airframe);

/// Of the numbers of a derivative model alone: signs, ratios of mass, inertia and lengths, what is
/// so small that it is per degree or in radians, the propeller.
std::vector<Finding> CheckDerivatives(const DerivativeAircraft& aircraft);

/// Of level flight: that there is any, and how slow. `limits` are those that the envelope was found
/// with.
std::vector<Finding> CheckEnvelope(const Plant& plant, const TuningLimits& limits,
                                   const FlightEnvelope& envelope);

/// Of drag in the envelope's trims, which is never negative; an error ends in `cause`.
std::vector<Finding> CheckDrag(const Plant& plant, const FlightEnvelope& envelope,
                               const std::string& cause);

/// Of the aircraft without flight control.
std::vector<Finding> CheckModes(const Plant& plant, const FlightEnvelope& envelope);

/// Of the aircraft as its flight control flies it at `trim`.
std::vector<Finding> CheckHandling(const TuningLimits& limits, double stall_alpha_deg,
                                   const TrimPoint& trim, const Handling& handling);

}  // namespace skein
