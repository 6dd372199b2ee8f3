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

/// The float64 aircraft of what LoadAircraft takes, with its centre of gravity (a fraction of the
/// mean chord) elsewhere if `cg` says so. Throws as LoadAircraft.
Plant MakePlant(const std::string& aircraft, AtmosphereModel atmosphere, std::optional<double> cg,
                double engine_angular_momentum);

/// From the five numbers of FdmControls, and to them.
Controls ToControls(const double* numbers);
FdmControls ToNumbers(const Controls& controls);

}  // namespace skein
