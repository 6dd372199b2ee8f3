// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "envs/aircraft/piston_engine.h"
#include "envs/aircraft/propeller.h"

namespace skein {

struct ElectricPropulsion {
  Propeller propeller;
  PropellerLevels levels;
  PropellerCells cells;
};

struct PistonPropulsion {
  PistonEngine engine;
  ThrottleLevels levels;
  ThrustRange range;
};

/// What drives an aircraft: motor and propeller, piston engine and propeller, or tables as they
/// are, as of a jet.
using Propulsion = std::variant<ElectricPropulsion, PistonPropulsion, EngineTables>;

/// Its thrust in tables.
EngineTables TabulateThrust(const Propulsion& propulsion);

}  // namespace skein
