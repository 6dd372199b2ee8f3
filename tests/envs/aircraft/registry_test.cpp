// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "envs/env_config.h"

namespace skein {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

TEST(AircraftRegistryTest, EveryNameLoadsTheAircraftOfThatName) {
  const std::vector<std::string> names = AircraftNames();
  ASSERT_FALSE(names.empty());
  for (const std::string& name : names) {
    const Aircraft aircraft = LoadAircraft(name);
    EXPECT_EQ(aircraft.name, name);
    EXPECT_GT(aircraft.airframe.mass_slug, 0);
    EXPECT_FALSE(aircraft.engine.maximum_lbf.empty());
  }
}

TEST(AircraftRegistryTest, NamesAreDistinctAndHoldTheDefault) {
  const std::vector<std::string> names = AircraftNames();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  EXPECT_THAT(names, Contains(EnvConfig{}.aircraft));
}

TEST(AircraftRegistryTest, AnUnknownNameIsAnErrorThatListsTheKnownOnes) {
  for (const std::string unknown : {"f22", "", "F16", "f16 "}) {
    try {
      LoadAircraft(unknown);
      FAIL() << '"' << unknown << "\" was loaded";
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr('"' + unknown + '"'));
      for (const std::string& name : AircraftNames()) EXPECT_THAT(error.what(), HasSubstr(name));
    }
  }
}

}  // namespace
}  // namespace skein
