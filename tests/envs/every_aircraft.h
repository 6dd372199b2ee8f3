// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "envs/aircraft/registry.h"
#include "simd/target.h"

namespace skein {

/// What laws that hold for every aircraft on every SIMD target are tested with.
struct AircraftOnTarget {
  std::string aircraft;
  simd::Target target;

  friend std::ostream& operator<<(std::ostream& out, const AircraftOnTarget& parameter) {
    return out << parameter.aircraft << " on " << simd::Name(parameter.target);
  }
};

inline std::vector<AircraftOnTarget> EveryAircraftOnEveryTarget() {
  std::vector<AircraftOnTarget> parameters;
  for (const std::string& name : AircraftNames()) {
    for (const simd::Target target : simd::SupportedTargets()) parameters.push_back({name, target});
  }
  return parameters;
}

/// Its name in a list of tests.
inline std::string AircraftOnTargetName(const testing::TestParamInfo<AircraftOnTarget>& test) {
  return test.param.aircraft + "_" + simd::Name(test.param.target);
}

}  // namespace skein
