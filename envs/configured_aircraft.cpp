// SPDX-License-Identifier: Apache-2.0
#include "envs/configured_aircraft.h"

#include <string>

#include "base/choice_error.h"
#include "envs/aircraft/registry.h"

namespace skein {

Aircraft ConfiguredAircraft(const EnvConfig& config) {
  Aircraft aircraft = LoadAircraft(config.aircraft);
  aircraft.airframe.cg = config.cg;
  aircraft.airframe.engine_angular_momentum = config.engine_angular_momentum;
  const auto require = [&](bool asked, const MachFunction& function, const char* key) {
    if (!asked || !function.mach.empty()) return;
    throw ChoiceError("configuration: " + std::string(key) + " = true, but the aircraft " +
                      config.aircraft + " has no data for it; it must be false");
  };
  require(config.thrust_grows, aircraft.engine.growth, "env.thrust_growth_above_mach_1");
  require(config.drag_rises, aircraft.drag_rise, "env.drag_rise");
  aircraft.engine.grows = config.thrust_grows;
  aircraft.drag_rises = config.drag_rises;
  return aircraft;
}

}  // namespace skein
