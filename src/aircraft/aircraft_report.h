// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "envs/aircraft/aircraft_document.h"
#include "envs/tuning/aircraft_findings.h"

namespace skein {

/// An aircraft as it is checked: in the U.S. Standard Atmosphere 1976, the centre of gravity where
/// its tables or derivatives are taken.
struct CheckedAircraft {
  AircraftDocument document;
  Plant plant;
  TuningLimits limits;
  bool has_flight_control = true;
  std::vector<Finding> findings;  ///< of its numbers alone
};

/// The aircraft that `aircraft` names: one of envs/aircraft/registry.h, or a file, which may lack
/// the section flight_control. Throws Error as the readers do.
CheckedAircraft LoadForCheck(const std::string& aircraft);

/// What a check found in flight, and the figures it saw on the way.
struct AircraftReport {
  std::vector<Finding> findings;  ///< beside those of CheckedAircraft
  std::string figures;            ///< tables for people: envelope, modes, closed loop
};

/// Of its presets, and as it flies.
AircraftReport CheckAircraft(const CheckedAircraft& aircraft);

/// The table of how flight control flies the aircraft over `envelope`; what is found wrong is
/// appended to `findings`.
std::string DescribeHandling(const Plant& plant, const TuningLimits& limits,
                             const FlightEnvelope& envelope, std::vector<Finding>* findings);

/// Over which aircraft are checked and their gains shown.
FlightEnvelope ReportEnvelope(const Plant& plant, const TuningLimits& limits);

}  // namespace skein
