#include "envs/aircraft/registry.h"

#include <array>

#include "envs/aircraft/f16/f16.h"
#include "simd/error.h"

namespace skein {
namespace {

struct Registration {
  const char* name;
  Aircraft (*load)();
};

constexpr std::array<Registration, 1> kAircraft = {{{"f16", F16}}};

}  // namespace

std::vector<std::string> AircraftNames() {
  std::vector<std::string> names;
  for (const Registration& aircraft : kAircraft) names.emplace_back(aircraft.name);
  return names;
}

Aircraft LoadAircraft(const std::string& name) {
  std::string known;
  for (const Registration& aircraft : kAircraft) {
    if (name == aircraft.name) return aircraft.load();
    known += (known.empty() ? "" : ", ") + std::string(aircraft.name);
  }
  throw Error("environment: unknown aircraft \"" + name + "\"; known: " + known);
}

}  // namespace skein
