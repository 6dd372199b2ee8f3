// SPDX-License-Identifier: Apache-2.0
#include "src/study/study_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/error_message.h"

namespace skein {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

Json ComparisonOf(const std::vector<std::string>& names) {
  Json comparison = {{"agents", Json::array()}};
  for (const std::string& name : names) comparison["agents"].push_back({{"name", name}});
  return comparison;
}

TEST(StudyReport, SeedsAreThoseOfTheFirstAgents) {
  EXPECT_THAT(SeedsOf(ComparisonOf({"seed 3", "seed 18446744073709551615", "zero", "seed 5"})),
              ElementsAre(3, std::numeric_limits<std::uint64_t>::max()));
  EXPECT_TRUE(SeedsOf(ComparisonOf({"zero"})).empty());
}

TEST(StudyReport, NamesThatAreNoSeedsAreRefused) {
  for (const char* name :
       {"seed ", "seed x", "seed 4 of 5", "seed -1", "seed 18446744073709551616"}) {
    const std::string error = MessageOf([&] { SeedsOf(ComparisonOf({"seed 1", name})); });
    EXPECT_THAT(error, HasSubstr(std::string("'") + name + "', which is no seed"));
  }
}

}  // namespace
}  // namespace skein
