// SPDX-License-Identifier: Apache-2.0
#include "src/fdm/fdm_plant.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "envs/aircraft/registry.h"
#include "src/config/usage_error.h"

namespace skein {

std::vector<std::string> AtmosphereNames() {
  std::vector<std::string> names;
  for (const auto& [model, name] : kAtmosphereNames) names.emplace_back(name);
  return names;
}

AtmosphereModel AtmosphereNamed(const std::string& name) {
  for (const auto& [model, known] : kAtmosphereNames) {
    if (name == known) return model;
  }
  throw UsageError(
      fmt::format("atmosphere \"{}\": {} are known", name, fmt::join(AtmosphereNames(), " and ")));
}

Plant MakePlant(const std::string& aircraft, AtmosphereModel atmosphere, const Gravity& gravity,
                const PlantSetting& setting) {
  Aircraft flown = AsUsage([&] { return LoadAircraft(aircraft); });
  const auto require = [&](bool asked, const MachFunction& data, const char* what) {
    if (asked && data.mach.empty()) {
      throw UsageError(fmt::format("aircraft {} has no data of {}", flown.name, what));
    }
    return asked;
  };
  flown.drag_rises = require(setting.drag_rises, flown.drag_rise, "drag rise");
  flown.engine.grows = require(setting.thrust_grows, flown.engine.growth, "thrust above Mach 1");
  if (setting.cg) flown.airframe.cg = *setting.cg;
  flown.airframe.engine_angular_momentum = setting.engine_angular_momentum;
  return {std::move(flown), atmosphere, 1, gravity};
}

Controls ToControls(const double* numbers) {
  return {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4]};
}

FdmControls ToNumbers(const Controls& controls) {
  return {controls.thrust_lbf, controls.elevator_deg, controls.aileron_deg, controls.rudder_deg,
          controls.leading_edge_flap_deg};
}

}  // namespace skein
