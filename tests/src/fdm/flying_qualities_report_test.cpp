// SPDX-License-Identifier: Apache-2.0
#include "src/fdm/flying_qualities_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>

namespace skein {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

std::string TextOf(double pitch_mismatch, double roll_mismatch) {
  FlyingQualities qualities;
  qualities.short_period = {2, 0.7, 0.05, pitch_mismatch};
  qualities.roll = {0.2, 0.01, roll_mismatch};
  return Describe(qualities, "");
}

TEST(FlyingQualitiesReport, SaysWhichResponseHasNoEquivalentSystem) {
  const char* const of_pitch = "the response is not of second order";
  const char* const of_roll = "the response is not of first order";
  EXPECT_THAT(TextOf(kMostMismatch, kMostMismatch), Not(HasSubstr("the response is not")));
  EXPECT_THAT(TextOf(42.6, 1), HasSubstr(of_pitch));
  EXPECT_THAT(TextOf(42.6, 1), Not(HasSubstr(of_roll)));
  EXPECT_THAT(TextOf(1, 42.6), HasSubstr("(mismatch 42.6, above 10: the response is not of first"));
  EXPECT_THAT(TextOf(1, 42.6), Not(HasSubstr(of_pitch)));
}

/// Of a closed loop with a mode that grows.
AssessedFlight UnstableFlight(std::complex<double> eigenvalue) {
  const double none = std::nan("");
  AssessedFlight flight;
  FlyingQualities& qualities = flight.qualities;
  qualities.unstable_mode = LinearMode{eigenvalue, {}};
  qualities.short_period = {none, none, none, none};
  qualities.roll = {none, none, none};
  qualities.requirements.push_back({"3.2.2.1.2", "short-period damping", "1", none, 4, ""});
  return flight;
}

TEST(FlyingQualitiesReport, SaysOfAnUnstableClosedLoopThatAlone) {
  const AssessedFlight flight = UnstableFlight({5.5429, 33.9648});
  const std::string text = Describe(flight.qualities, "");
  EXPECT_THAT(text, HasSubstr("the closed loop is unstable: 34.4 rad/s, time to double 0.125 s; "
                              "margins and equivalent systems have no meaning\n"));
  EXPECT_THAT(text, Not(HasSubstr("equivalent short period")));
  EXPECT_THAT(text, Not(HasSubstr("loop broken at")));
  EXPECT_THAT(text, HasSubstr("below 3"));
  EXPECT_THAT(Describe(UnstableFlight(0.324).qualities, ""),
              HasSubstr("unstable: time to double 2.14 s;"));
  EXPECT_THAT(DescribeLevels({flight}), ContainsRegex(">3 .* unstable +unstable +-\n"));
}

TEST(FlyingQualitiesReport, AFileHasTheModeThatGrowsAndNoFiguresOfWhatThereIsNot) {
  const auto json = ToJson(UnstableFlight({5.5429, 33.9648}));
  EXPECT_EQ(json["unstable_mode"]["eigenvalue_per_s"][1], 33.9648);
  EXPECT_TRUE(json["equivalent_short_period"]["damping_ratio"].is_null());
  EXPECT_TRUE(json["equivalent_roll"]["delay_s"].is_null());
  EXPECT_EQ(json["loops"], nlohmann::ordered_json::array());
  AssessedFlight stable;
  stable.qualities.short_period = {2, 0.7, 0.05, 1};
  EXPECT_TRUE(ToJson(stable)["unstable_mode"].is_null());
  EXPECT_EQ(ToJson(stable)["equivalent_short_period"]["damping_ratio"], 0.7);
}

}  // namespace
}  // namespace skein
