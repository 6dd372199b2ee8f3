// SPDX-License-Identifier: Apache-2.0
#include "envs/autopilot/gains.h"

#include <array>

#include "base/error.h"
#include "base/nearest_name.h"

namespace skein {
namespace {

struct Registration {
  const char* name;
  AutopilotVariant variant;
};

constexpr std::array<Registration, 4> kAutopilots = {
    {{"public", AutopilotVariant::kPublic},
     {"traditional", AutopilotVariant::kTraditional},
     {"aggressive", AutopilotVariant::kAggressive},
     {"parallel", AutopilotVariant::kParallel}}};

}  // namespace

AutopilotGains GainsOf(AutopilotVariant variant) {
  AutopilotGains gains;
  switch (variant) {
    case AutopilotVariant::kPublic:
      gains.lift.max_bank = Radians(45);
      gains.tecs.max_climb_angle = Radians(15);
      gains.sequencer.enabled = false;
      break;
    case AutopilotVariant::kTraditional:
      break;
    case AutopilotVariant::kAggressive:
    case AutopilotVariant::kParallel:
      gains.lift.over_bank = true;
      gains.lift.pitch_time_s = 1;
      gains.sequencer.enabled = variant == AutopilotVariant::kAggressive;
      break;
  }
  return gains;
}

std::vector<std::string> AutopilotNames() {
  std::vector<std::string> names;
  for (const Registration& autopilot : kAutopilots) names.emplace_back(autopilot.name);
  return names;
}

AutopilotVariant AutopilotOf(const std::string& name) {
  for (const Registration& autopilot : kAutopilots) {
    if (name == autopilot.name) return autopilot.variant;
  }
  std::string known;
  for (const std::string& other : AutopilotNames()) known += (known.empty() ? "" : ", ") + other;
  throw Error("unknown autopilot \"" + name + "\"" + DidYouMean(name, AutopilotNames()) +
              "; known: " + known);
}

}  // namespace skein
