// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/propulsion.h"

namespace skein {

EngineTables TabulateThrust(const Propulsion& propulsion) {
  if (const auto* electric = std::get_if<ElectricPropulsion>(&propulsion)) {
    return TabulatePropeller(electric->propeller, electric->levels, electric->cells);
  }
  if (const auto* piston = std::get_if<PistonPropulsion>(&propulsion)) {
    return TabulatePiston(piston->engine, piston->levels, piston->range);
  }
  return std::get<EngineTables>(propulsion);
}

}  // namespace skein
