// SPDX-License-Identifier: Apache-2.0
#include "src/study/study_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "base/number_text.h"
#include "src/evaluation/flight_summary.h"
#include "tests/error_message.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::NanSensitiveDoubleNear;
using ::testing::Not;
using ::testing::Pointwise;
using Json = nlohmann::ordered_json;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr Tolerance kTable{1e-3, "a table of Student's t has three decimals"};
// 97.5 % points of Student's t with one and two degrees of freedom (NIST/SEMATECH e-Handbook of
// Statistical Methods, 1.3.6.7.2).
constexpr double kOneDegree = 12.706, kTwoDegrees = 4.303;

Json ComparisonOf(const std::vector<std::string>& names) {
  Json comparison = {{"agents", Json::array()}};
  for (const std::string& name : names) comparison["agents"].push_back({{"name", name}});
  return comparison;
}

std::vector<Quantity> Quantities() {
  const auto quantity = [](const char* key, const char* label, double shown, Statistic statistic) {
    return Quantity{key, "", label, shown, 1, {}, QuantitySection::kOutcome, statistic, true};
  };
  return {quantity("success_rate", "success, %", 100, Statistic::kShare),
          quantity("return", "return", 1, Statistic::kMean),
          quantity("time_s", "time, s", 1, Statistic::kMean),
          quantity("held", "held, %", 100, Statistic::kShare)};
}

/// What each of three seeds and then the agent "zero" did, by the key of the quantity.
using Figures = std::map<std::string, std::vector<Estimate>>;

/// Of three seeds, of which only the means matter, and the agent's own.
std::vector<Estimate> OfSeeds(double first, double second, double third, const Estimate& zero) {
  return {{first, 0, 1, 20}, {second, 0, 1, 20}, {third, 0, 1, 20}, zero};
}

Json ResultOf(const std::string& level, const Figures& figures) {
  Json comparison = ComparisonOf({"seed 1", "seed 2", "seed 7", "zero"});
  comparison["episodes"] = 20;
  for (const auto& [key, estimates] : figures) {
    for (std::size_t i = 0; i < estimates.size(); ++i) {
      comparison["agents"][i]["estimates"][key] = ToJson(estimates[i]);
    }
  }
  return {{"task", "heading"}, {"level", level}, {"comparison", comparison}};
}

/// Shares whose intervals leave [0, 1] at either side, returns that differ and that do not, times
/// that one and two seeds have not, and a quantity that only one level knows, and has no value of.
Json Results() {
  const Estimate none{kNaN, kNaN, kNaN, 0};
  const Figures quiet = {{"success_rate", OfSeeds(0.9, 1, 1, {0.05, 0.01, 0.24, 20})},
                         {"return", OfSeeds(-1, 2, 5, {-3, -4, -2, 20})},
                         {"time_s", OfSeeds(10, kNaN, 14, none)}};
  const Figures loud = {{"success_rate", OfSeeds(0, 0, 0.3, {0, 0, 0.16, 20})},
                        {"return", OfSeeds(4, 4, 4, {-3, -4, -2, 20})},
                        {"time_s", OfSeeds(kNaN, 30, kNaN, none)},
                        {"held", OfSeeds(kNaN, kNaN, kNaN, none)}};
  return Json::array({ResultOf("quiet", quiet), ResultOf("loud", loud)});
}

/// The cells behind `begin` in the row that begins so; NaN of those without a number.
std::vector<double> CellsBehind(const std::string& begin, const std::string& csv) {
  std::istringstream lines(csv);
  std::vector<double> numbers;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(begin, 0) != 0) continue;
    std::istringstream cells(line.substr(begin.size()) + ",");
    for (std::string cell; std::getline(cells, cell, ',');) {
      numbers.push_back(NumberOf(cell).value_or(kNaN));
    }
  }
  return numbers;
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

// The standard error of three values is their standard deviation over the root of three: 1/30 of
// 0.9, 1, 1, a tenth of 0, 0, 0.3, and the root of three of -1, 2, 5; that of 10 and 14 is 2.
TEST(StudyReport, TrainedIsTheMeanOverSeedsWithStudentsInterval) {
  const std::string csv = StudyCsv(Results(), Quantities());
  const double of_return = kTwoDegrees * std::sqrt(3.0), of_time = kOneDegree * 2;
  const std::vector<double> quiet = {2.9 / 3,
                                     2.9 / 3 - kTwoDegrees / 30,
                                     1,
                                     2,
                                     2 - of_return,
                                     2 + of_return,
                                     12,
                                     12 - of_time,
                                     12 + of_time,
                                     kNaN,
                                     kNaN,
                                     kNaN};
  const std::vector<double> loud = {
      0.1, 0, 0.1 + kTwoDegrees / 10, 4, 4, 4, 30, kNaN, kNaN, kNaN, kNaN, kNaN};
  EXPECT_THAT(CellsBehind("heading,quiet,trained,20,3,", csv),
              Pointwise(NanSensitiveDoubleNear(kTable), quiet));
  EXPECT_THAT(CellsBehind("heading,loud,trained,20,3,", csv),
              Pointwise(NanSensitiveDoubleNear(kTable), loud));
}

TEST(StudyReport, EveryAgentHasARowOfItsOwnFigures) {
  const std::string csv = StudyCsv(Results(), Quantities());
  EXPECT_EQ(csv.substr(0, csv.find(",return")),
            "task,level,agent,episodes,seeds,success_rate,success_rate_low,success_rate_high");
  EXPECT_THAT(csv, HasSubstr("\nheading,quiet,seed 2,20,1,1,0,1,2,0,1,,0,1,,,\n"));
  EXPECT_THAT(csv, HasSubstr("\nheading,quiet,zero,20,,0.05,0.01,0.24,-3,-4,-2,,,,,,\n"));
}

TEST(StudyReport, TaskFilesMayHaveCommasInTheirNames) {
  Json results = Results();
  for (Json& result : results) result["task"] = "tasks/steep, slow.toml";
  EXPECT_THAT(StudyCsv(results, Quantities()),
              HasSubstr("\n\"tasks/steep, slow.toml\",quiet,zero,20,,0.05,"));
}

TEST(StudyReport, PeopleSeeTheMeanOfTheSeedsAndTheLowestAndHighest) {
  const std::string text =
      std::regex_replace(StudyText(Results(), Quantities()), std::regex(" +"), " ");
  EXPECT_THAT(text, HasSubstr("success, % trained (3 seeds) zero\n"
                              " heading, quiet 96.7 (90.0 to 100.0) 5.0 (1.0, 24.0)\n"
                              " heading, loud 10.0 (0.0 to 30.0) 0.0 (0.0, 16.0)\n"));
  EXPECT_THAT(text, HasSubstr("time, s trained (3 seeds) zero\n"
                              " heading, quiet 12.0 (10.0 to 14.0) -\n"
                              " heading, loud 30.0 -\n"));
  EXPECT_THAT(text, HasSubstr("held, % trained (3 seeds) zero\n heading, loud - -\n"));
  EXPECT_THAT(text, Not(HasSubstr("return"))) << "of no meaning to people";
}

}  // namespace
}  // namespace skein
