// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "envs/reference/plant.h"
#include "src/fdm/fdm_file.h"

namespace skein {

/// The names of kAtmosphereNames.
std::vector<std::string> AtmosphereNames();

/// Throws UsageError with the known names on another one.
AtmosphereModel AtmosphereNamed(const std::string& name);

/// What may be set of an aircraft.
struct PlantSetting {
  std::optional<double> cg;  ///< fraction of the mean chord; without it the aircraft's own
  double engine_angular_momentum = 0;  ///< slug ft^2/s
  bool drag_rises = false;             ///< with the Mach number
  bool thrust_grows = false;           ///< above Mach 1
};

/// The float64 aircraft of what LoadAircraft takes. Throws as LoadAircraft, and UsageError of a
/// setting that the aircraft has no data for.
Plant MakePlant(const std::string& aircraft, AtmosphereModel atmosphere, const Gravity& gravity,
                const PlantSetting& setting);

/// From the five numbers of FdmControls, and to them.
Controls ToControls(const double* numbers);
FdmControls ToNumbers(const Controls& controls);

}  // namespace skein
