// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/registry.h"

#include <array>

#include "base/error.h"
#include "envs/aircraft/derivative_aircraft_file.h"
#include "envs/aircraft/f16.h"

namespace skein {
namespace {

/// Aircraft with a loader of their own.
struct Registration {
  const char* name;
  Aircraft (*load)();
};

constexpr std::array<Registration, 1> kAircraft = {{{"f16", F16}}};

}  // namespace

std::vector<std::string> AircraftNames() {
  std::vector<std::string> names;
  for (const Registration& aircraft : kAircraft) names.emplace_back(aircraft.name);
  for (const AircraftFile& file : AircraftFiles()) names.emplace_back(file.name);
  return names;
}

Aircraft LoadAircraft(const std::string& name) {
  for (const Registration& aircraft : kAircraft) {
    if (name == aircraft.name) return aircraft.load();
  }
  for (const AircraftFile& file : AircraftFiles()) {
    if (name == file.name) return MakeAircraft(ReadDerivativeAircraft(name, *file.text));
  }
  std::string known;
  for (const std::string& aircraft : AircraftNames()) {
    known += (known.empty() ? "" : ", ") + aircraft;
  }
  throw Error("environment: unknown aircraft \"" + name + "\"; known: " + known);
}

}  // namespace skein
