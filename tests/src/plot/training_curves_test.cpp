// SPDX-License-Identifier: Apache-2.0
#include "src/plot/training_curves.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "src/files/csv_columns.h"
#include "src/run/metrics.h"
#include "tests/error_message.h"

namespace skein {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kRounding = 1e-12;

/// A run with a share at every million of steps, that took a minute for each.
RunRecord RunOf(const std::string& name, const std::vector<double>& shares,
                const std::string& task = "heading", std::uint64_t seed = 0) {
  RunRecord run;
  run.path = run.name = name;
  run.config.train.env.task = task;
  run.config.train.seed = seed;
  run.metrics.names = {"env_steps", "evaluation_success_rate"};
  run.metrics.values.resize(2);
  for (std::size_t k = 0; k < shares.size(); ++k) {
    run.metrics.values[0].push_back(1e6 * static_cast<double>(k + 1));
    run.metrics.values[1].push_back(shares[k]);
  }
  run.timing.names = {"env_steps", "rollout_s", "update_s", "evaluation_s"};
  run.timing.values = {{1e6, 2e6}, {10, 10}, {20, 20}, {0, 60}};
  return run;
}

std::vector<std::string> WordsOf(const Picture& picture) {
  std::vector<std::string> all;
  for (const Shape& shape : picture.shapes) {
    if (const auto* const words = std::get_if<Words>(&shape)) all.push_back(words->text);
  }
  return all;
}

TEST(TrainingCurvesTest, MeanAndBandAreThoseOfTheSeeds) {
  const CurveSetting setting{
      "heading", "", {RunOf("a", {0.1, std::nan(""), 0.5}), RunOf("b", {0.3, 0.4, 0.9})}};
  const SeedCurve curve = CurveOf(setting, "evaluation_success_rate");
  const double means[] = {20, 35, 70}, lows[] = {10, 30, 50}, highs[] = {30, 40, 90};
  ASSERT_EQ(curve.mean.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(curve.mean[k].y, means[k], 100 * kRounding);
    EXPECT_NEAR(curve.low[k].y, lows[k], 100 * kRounding);
    EXPECT_NEAR(curve.high[k].y, highs[k], 100 * kRounding);
    EXPECT_NEAR(curve.mean[k].x, static_cast<double>(k + 1), kRounding);
  }
  EXPECT_NEAR(*MinutesPerMillion(setting), 1, kRounding) << "120 s for two million";
}

TEST(TrainingCurvesTest, TheTitleSaysWhatASuccessIs) {
  // Words as they are wrapped, put together again.
  const auto titles = [](std::vector<RunRecord> runs, const std::string& column) {
    std::vector<CurveSetting> settings;
    for (RunRecord& run : runs) {
      run.metrics.names[1] = column;
      settings.push_back({"heading", run.name, {run}});
    }
    CurveOptions options;
    options.columns = {column};
    std::string all;
    for (const std::string& words : WordsOf(TrainingCurves(settings, options))) all += words + " ";
    return all;
  };
  const RunRecord one_target = RunOf("a", {0.1, 0.5});
  RunRecord trained_on = RunOf("b", {0.1, 0.5}), evaluated_on = RunOf("c", {0.1, 0.5});
  trained_on.config.train.env.mission.training_length_s = 180;
  evaluated_on.config.train.env.mission.length_s = 600;
  for (const char* column : {"success_rate", "evaluation_success_rate"}) {
    EXPECT_THAT(titles({one_target}, column), HasSubstr("reach their target"));
    EXPECT_THAT(titles({one_target}, column), Not(HasSubstr("missions")));
    EXPECT_THAT(titles({evaluated_on}, column), HasSubstr("missions flown to their end"));
    EXPECT_THAT(titles({evaluated_on}, column), Not(HasSubstr("reach their target")));
  }
  EXPECT_THAT(titles({trained_on}, "success_rate"), HasSubstr("training missions flown to"));
  EXPECT_THAT(titles({trained_on}, "evaluation_success_rate"), Not(HasSubstr("missions")));
  EXPECT_THAT(titles({one_target, trained_on}, "success_rate"),
              AllOf(HasSubstr("reach their target"), HasSubstr("missions flown to")));
}

TEST(TrainingCurvesTest, WhatIsShownInPercentIsLabelledSo) {
  for (const std::string& column : ParseCsv(MetricsHeader()).names) {
    RunRecord run = RunOf("a", {0.1, 0.5});
    if (column != "env_steps") run.metrics.names[1] = column;
    const CurveSetting setting{"heading", "a", {run}};
    const bool is_scaled =
        CurveOf(setting, column).mean.front().y != run.metrics.Find(column)->front();
    CurveOptions options;
    options.columns = {column};
    const std::vector<std::string> words = WordsOf(TrainingCurves({setting}, options));
    const bool is_labelled = testing::Matches(Contains(EndsWith("%")))(words);
    EXPECT_EQ(is_labelled, is_scaled) << column;
    EXPECT_EQ(is_scaled, testing::Matches(EndsWith("success_rate"))(column)) << column;
  }
}

TEST(TrainingCurvesTest, RunsOfOneConfigurationAreSeedsOfASetting) {
  const auto runs = [] {
    return std::vector<RunRecord>{RunOf("a", {0.1, 0.2}, "heading", 1),
                                  RunOf("b", {0.2, 0.3}, "control", 1),
                                  RunOf("c", {0.3, 0.4}, "heading", 2)};
  };
  const std::vector<CurveSetting> settings = SettingsOf(runs(), std::nullopt, {});
  ASSERT_EQ(settings.size(), 2u);
  EXPECT_EQ(settings[0].runs.size(), 2u);
  EXPECT_EQ(settings[1].task, "control");
  EXPECT_THAT(MessageOf([&] { SettingsOf(runs(), 2, {}); }),
              HasSubstr("b: of another task than a"));
  EXPECT_THAT(MessageOf([&] { SettingsOf(runs(), std::nullopt, {"x"}); }),
              HasSubstr("1 name for 2 settings"));
}

TEST(TrainingCurvesTest, SettingsOfATaskThatHaveTheSameNameAreCalledByTheirPaths) {
  const auto run = [](const std::string& path, const std::string& name, const char* task) {
    RunRecord record = RunOf(name, {0.1, 0.5}, task);
    record.path = path;
    return record;
  };
  const auto runs = [&] {
    return std::vector<RunRecord>{
        run("sa/seed-1", "seed-1", "heading"), run("sb/seed-1", "seed-1", "heading"),
        run("sb/seed-2", "seed-2", "heading"), run("sc/seed-2", "seed-2", "control")};
  };
  const auto names_of = [](const std::vector<CurveSetting>& settings) {
    std::vector<std::string> names;
    for (const CurveSetting& setting : settings) names.push_back(setting.name);
    return names;
  };
  EXPECT_THAT(names_of(SettingsOf(runs(), 1, {})),
              ElementsAre("sa/seed-1", "sb/seed-1", "seed-2", "seed-2"));
  EXPECT_THAT(names_of(SettingsOf(runs(), 1, {"a", "b", "c", "d"})),
              ElementsAre("a", "b", "c", "d"));
}

TEST(TrainingCurvesTest, RunsWithoutAValueAreLeftOutAndNamed) {
  const std::vector<std::string> columns = {"evaluation_success_rate"};
  std::vector<CurveSetting> settings =
      SettingsOf({RunOf("a", {std::nan("")}), RunOf("b", {0.2, 0.7}, "control"), RunOf("c", {})},
                 std::nullopt, {"first", "second"});
  std::vector<std::string> notes;
  LeaveOutRunsWithoutValues(columns, &settings, &notes);
  ASSERT_EQ(settings.size(), 1u);
  EXPECT_EQ(settings[0].name, "second");
  EXPECT_THAT(notes, ElementsAre("a: column evaluation_success_rate has no values yet; left out",
                                 "c: column evaluation_success_rate has no values yet; left out"));
  std::vector<CurveSetting> none = SettingsOf({RunOf("a", {})}, std::nullopt, {});
  EXPECT_THAT(MessageOf([&] { LeaveOutRunsWithoutValues(columns, &none, &notes); }),
              HasSubstr("a: column evaluation_success_rate has no values yet"));
}

TEST(TrainingCurvesTest, RunsWithoutCommonStepsAreNotPutTogether) {
  const double none = std::nan("");
  const CurveSetting setting{
      "heading", "", {RunOf("a", {0.1, 0.2}), RunOf("b", {none, none, 0.4, 0.5})}};
  EXPECT_THAT(MessageOf([&] { CurveOf(setting, "evaluation_success_rate"); }),
              HasSubstr("a and b have no control steps in common for evaluation_success_rate; "
                        "--seeds 1 draws each for itself"));
}

TEST(TrainingCurvesTest, ACurveGoesOnBeyondItsEndsAsItEnds) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<PagePoint> curve = {{0.1, 3}, {0.7, 5}};
  EXPECT_EQ(Interpolated(curve, std::nextafter(0.1, -kInfinity)), 3);
  EXPECT_EQ(Interpolated(curve, std::nextafter(0.7, kInfinity)), 5);
}

TEST(TrainingCurvesTest, ACurveIsStraightBetweenItsPoints) {
  const std::vector<PagePoint> curve = {{0, 3}, {4, 5}, {5, 1}};
  for (const PagePoint& point : {PagePoint{1, 3.5}, {3, 4.5}, {4, 5}, {4.25, 4}}) {
    EXPECT_NEAR(Interpolated(curve, point.x), point.y, kRounding) << point.x;
  }
}

TEST(TrainingCurvesTest, EachTaskHasAPanel) {
  const std::vector<CurveSetting> settings =
      SettingsOf({RunOf("a", {0.1, 0.5}), RunOf("b", {0.2, 0.7}, "control")}, std::nullopt, {});
  CurveOptions options;
  options.autopilots["heading"] = {"aggressive autopilot", 0.995};
  options.machine = "two threads";
  const std::vector<std::string> words = WordsOf(TrainingCurves(settings, options));
  for (const char* wanted :
       {"Heading: a new altitude, heading and speed", "Control: a new pitch, heading and speed",
        "aggressive autopilot: 99.5 %", "minutes on two threads", "control steps, million",
        "one seed"}) {
    EXPECT_THAT(words, Contains(wanted));
  }
}

TEST(TrainingCurvesTest, ARunThatIsGivenTwiceIsNoSecondSeed) {
  EXPECT_THAT(MessageOf([] {
                SettingsOf({RunOf("runs/a", {0.1}), RunOf("runs/b/../a", {0.1})}, std::nullopt, {});
              }),
              HasSubstr("runs/b/../a: it is there twice"));
}

using Style = std::tuple<Colour, Dash, double>;

/// How the line before the words looks, of each entry of the legend.
std::map<std::string, Style> LegendOf(const Picture& picture) {
  std::map<std::string, Style> legend;
  for (std::size_t k = 1; k < picture.shapes.size(); ++k) {
    const auto* const words = std::get_if<Words>(&picture.shapes[k]);
    const auto* const line = std::get_if<Path>(&picture.shapes[k - 1]);
    if (words == nullptr || line == nullptr || !line->stroke) continue;
    if (words->text.find("one seed") == std::string::npos) continue;
    legend[words->text] = {*line->stroke, line->dash, line->width};
  }
  return legend;
}

std::size_t CountCurves(const Picture& picture, const Style& style) {
  std::size_t count = 0;
  for (const Shape& shape : picture.shapes) {
    const auto* const path = std::get_if<Path>(&shape);
    count +=
        path != nullptr && path->stroke && Style{*path->stroke, path->dash, path->width} == style;
  }
  return count - 1;  // that of the legend
}

TEST(TrainingCurvesTest, TwelveSettingsLookDifferentAndAsTheLegendSays) {
  std::vector<CurveSetting> settings;
  for (int k = 0; k < 12; ++k) {
    const std::string name = "run " + std::to_string(k);
    settings.push_back({"heading", name, {RunOf(name, {0.1, 0.02 * k})}});
  }
  const Picture picture = TrainingCurves(settings, {});
  std::set<Style> different;
  for (const auto& [words, style] : LegendOf(picture)) {
    EXPECT_TRUE(different.insert(style).second) << words;
    EXPECT_EQ(CountCurves(picture, style), 1u) << words;
  }
  EXPECT_EQ(different.size(), 12u);
}

TEST(TrainingCurvesTest, ANameLooksTheSameInEveryTask) {
  const auto run = [](const char* task) { return std::vector{RunOf("a", {0.1, 0.5}, task)}; };
  const Picture picture = TrainingCurves({{"heading", "calm", run("heading")},
                                          {"heading", "windy", run("heading")},
                                          {"control", "windy", run("control")},
                                          {"control", "calm", run("control")}},
                                         {});
  const std::map<std::string, Style> legend = LegendOf(picture);
  ASSERT_EQ(legend.size(), 2u);
  for (const auto& [words, style] : legend) EXPECT_EQ(CountCurves(picture, style), 2u) << words;
}

TEST(TrainingCurvesTest, WhatIsNotThereIsSaid) {
  const std::vector<CurveSetting> settings =
      SettingsOf({RunOf("a", {std::nan("")})}, std::nullopt, {});
  EXPECT_THAT(MessageOf([&] { TrainingCurves(settings, {}); }),
              HasSubstr("a: column evaluation_success_rate has no values yet"));
  CurveOptions options;
  options.columns = {"altitude"};
  EXPECT_THAT(MessageOf([&] { TrainingCurves(settings, options); }),
              HasSubstr("a: metrics.csv has no column altitude; there are env_steps"));
}

}  // namespace
}  // namespace skein
