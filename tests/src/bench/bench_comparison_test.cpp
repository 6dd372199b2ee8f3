// SPDX-License-Identifier: Apache-2.0
#include "src/bench/bench_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "src/bench/figure.h"
#include "src/files/output_file.h"
#include "tests/error_message.h"
#include "tests/scratch_directory.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

constexpr Tolerance kRounding{1e-12, "float64 rounding"};
constexpr Tolerance kBiasOfSpread{
    0.08,
    "quartiles of few normal samples lie up to 6 % too far apart by order statistics; 1 % by "
    "chance"};

class BenchComparisonTest : public ::testing::Test {
 protected:
  /// A run whose only figures are these.
  std::string Write(const std::string& name, const std::vector<Figure>& figures,
                    const Json& changes = Json::object()) {
    Json document{{"benchmark", "sim"},
                  {"figures", ToJson(figures)},
                  {"settings", {{"task", "heading"}}},
                  {"threads", 2},
                  {"machine", {{"cpu", "one"}, {"simd", "avx2"}, {"commit", name}}}};
    document.merge_patch(changes);
    const std::string path = scratch_ / name;
    WriteJson(path, document);
    return path;
  }

  /// Log-normal samples about `middle`.
  std::vector<double> Samples(double middle, double deviation, int count = 10) {
    std::normal_distribution<double> normal(std::log(middle), deviation);
    std::vector<double> samples;
    for (int i = 0; i < count; ++i) samples.push_back(std::exp(normal(generator_)));
    return samples;
  }

  FigureChange Change(const std::string& name, bool more_is_better, double before, double after,
                      double deviation) {
    const std::string a = Write("a", {{name, more_is_better, Samples(before, deviation)}});
    const std::string b = Write("b", {{name, more_is_better, Samples(after, deviation)}});
    return CompareBenchmarks({a}, {b}, false).changes.at(0);
  }

  const ScratchDirectory scratch_;
  std::mt19937 generator_{7};
};

TEST_F(BenchComparisonTest, FindsAChangeThatIsLargerThanTheSpread) {
  const FigureChange slower = Change("step_ms", false, 10, 11, 0.01);
  EXPECT_TRUE(IsBeyondNoise(slower));
  EXPECT_GT(slower.ratio.low, 1.07);
  EXPECT_LT(slower.ratio.high, 1.13);
  const FigureChange faster = Change("steps_per_s", true, 10, 11, 0.01);
  EXPECT_TRUE(IsBeyondNoise(faster));
  EXPECT_FALSE(IsBeyondNoise(Change("step_ms", false, 10, 10.1, 0.1)));
}

TEST_F(BenchComparisonTest, NineteenOfTwentyIntervalsHoldTheRatio) {
  constexpr int kTrials = 400;
  int covered = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Estimate ratio = Change("step_ms", false, 3, 4, 0.2).ratio;
    covered += ratio.low <= 4.0 / 3 && 4.0 / 3 <= ratio.high;
  }
  // Three standard deviations of a binomial about 95 %.
  EXPECT_NEAR(covered, 0.95 * kTrials, 3 * std::sqrt(kTrials * 0.95 * 0.05));
}

TEST_F(BenchComparisonTest, PairsOfRunsCancelWhatBothSee) {
  std::vector<std::string> before, after;
  for (int i = 0; i < 5; ++i) {
    const double load = 1 + 0.5 * i;  // of the machine while the pair ran
    const std::string n = std::to_string(i);
    before.push_back(Write("a" + n, {{"step_ms", false, Samples(load, 0.001)}}));
    after.push_back(Write("b" + n, {{"step_ms", false, Samples(0.98 * load, 0.001)}}));
  }
  const BenchComparison paired = CompareBenchmarks(before, after, false);
  EXPECT_EQ(paired.runs, 5);
  EXPECT_TRUE(IsBeyondNoise(paired.changes.at(0)));
  EXPECT_LT(paired.changes[0].ratio.high, 0.99);
  EXPECT_THAT(ToText(paired), HasSubstr("better by 2"));
  after.pop_back();
  EXPECT_THAT(MessageOf([&] { CompareBenchmarks(before, after, false); }),
              HasSubstr("5 runs before and 4 runs after"));
}

TEST_F(BenchComparisonTest, OneSampleLeavesNoInterval) {
  const std::string a = Write("a", {{"step_ms", false, {1}}});
  const std::string b = Write("b", {{"step_ms", false, {2}}});
  const BenchComparison comparison = CompareBenchmarks({a}, {b}, false);
  EXPECT_FALSE(IsBeyondNoise(comparison.changes.at(0)));
  EXPECT_THAT(ToText(comparison), HasSubstr("no interval"));
  EXPECT_TRUE(ToJson(comparison)["figures"]["step_ms"]["low"].is_null());
}

TEST_F(BenchComparisonTest, SamplesThatAreAllAlikeLeaveNoInterval) {
  const std::vector<std::string> before = {Write("a", {{"step_ms", false, {3, 3, 3}}}),
                                           Write("b", {{"step_ms", false, {3, 3, 3}}})};
  const std::vector<std::string> after = {Write("c", {{"step_ms", false, {4, 4, 4}}}),
                                          Write("d", {{"step_ms", false, {4, 4, 4}}})};
  for (const BenchComparison& comparison : {CompareBenchmarks({before[0]}, {after[0]}, false),
                                            CompareBenchmarks(before, after, false)}) {
    EXPECT_FALSE(IsBeyondNoise(comparison.changes.at(0)));
    EXPECT_THAT(ToText(comparison), HasSubstr("all alike: no interval"));
  }
}

TEST_F(BenchComparisonTest, WhatOnlyOneSideHasIsSaid) {
  const std::string a = Write("a", {{"x", false, {1, 1}}, {"old", false, {1}}});
  const std::string b = Write("b", {{"x", false, {1, 1}}, {"new", false, {1}}});
  const BenchComparison comparison = CompareBenchmarks({a}, {b}, false);
  EXPECT_EQ(comparison.changes.size(), 1u);
  EXPECT_THAT(ToText(comparison), HasSubstr("not in all runs: old, new"));
}

TEST_F(BenchComparisonTest, WhatDiffersBesideTheCommitIsSaidInOneLine) {
  const std::vector<Figure> figures{{"x", false, {1, 2}}};
  const auto write = [&](const std::string& name, const std::string& compiler,
                         const std::string& type, const std::string& hash) {
    return Write(
        name, figures,
        {{"machine", {{"compiler", compiler}, {"build_type", type}}}, {"task_hash", hash}});
  };
  const std::string a = write("a", "GNU", "Release", "12"), b = write("b", "Clang", "Debug", "34"),
                    same = write("c", "GNU", "Release", "12"), old = Write("d", figures);
  const BenchComparison comparison = CompareBenchmarks({a}, {b}, false);
  EXPECT_THAT(ToText(comparison),
              HasSubstr("\n  differ  compiler GNU before, Clang after; build_type Release before, "
                        "Debug after; task_hash 12 before, 34 after\n"));
  EXPECT_EQ(ToJson(comparison)["differing"]["build_type"],
            (Json{{"before", "Release"}, {"after", "Debug"}}));
  for (const std::string& other : {same, old}) {
    EXPECT_TRUE(CompareBenchmarks({a}, {other}, false).differing.empty());
  }
  EXPECT_EQ(CompareBenchmarks({a, b}, {same, a}, false).differing.at(0).before, "GNU, Clang");
}

TEST_F(BenchComparisonTest, WhatCannotBeComparedIsRefused) {
  const std::vector<Figure> figures{{"x", false, {1, 2}}};
  const std::string a = Write("a", figures);
  const auto refusal = [&](const Json& changes, bool other_machine = false) {
    const std::string b = Write("b", figures, changes);
    return MessageOf([&] { CompareBenchmarks({a}, {b}, other_machine); });
  };
  EXPECT_EQ(refusal(Json::object()), "");
  EXPECT_THAT(refusal({{"benchmark", "update"}}), HasSubstr("benchmark is sim in one and update"));
  EXPECT_THAT(refusal({{"settings", {{"task", "control"}}}}), HasSubstr("settings"));
  for (const Json& changes : {Json{{"threads", 4}}, Json{{"machine", {{"cpu", "other"}}}},
                              Json{{"machine", {{"simd", "avx512"}}}}}) {
    EXPECT_THAT(refusal(changes), HasSubstr("--other-machine"));
    EXPECT_EQ(refusal(changes, true), "");
  }
  const Json zen{{"machine", {{"cpu_family", 25}, {"cpu_model", 17}}}};
  EXPECT_EQ(refusal(zen), "") << "the other file does not say it";
  const std::string zen4 = Write("zen4", figures, zen);
  const std::string zen5 =
      Write("zen5", figures, {{"machine", {{"cpu_family", 26}, {"cpu_model", 68}}}});
  EXPECT_THAT(MessageOf([&] { CompareBenchmarks({zen4}, {zen5}, false); }),
              HasSubstr("cpu_family is 25 in one and 26 in the other (--other-machine"));
  for (const auto& after : {std::vector<std::string>{a, zen5}, {zen5, zen4}}) {
    EXPECT_THAT(MessageOf([&] {
                  CompareBenchmarks({a, zen4}, after, false);
                }),
                HasSubstr("cannot be compared: cpu_family is"))
        << "whatever the first files say";
  }
  EXPECT_THAT(ToText(CompareBenchmarks({zen4}, {zen5}, true)),
              HasSubstr("one (family 25, model 17), avx2, 2 threads; after: one (family 26, "));
  EXPECT_THAT(refusal({{"figures", nullptr}}), HasSubstr("nothing that could be compared"));
  EXPECT_THAT(refusal({{"benchmark", nullptr}}), HasSubstr("not what skein bench --json writes"));
  EXPECT_THAT(refusal({{"figures", {{"x", 3}}}}), HasSubstr("figures cannot be read"));
  EXPECT_THAT(refusal({{"figures", {{"x", {{"samples", {1, -1}}}}}}}), HasSubstr("not above 0"));
  EXPECT_THAT(refusal({{"figures", {{"x", {{"samples", Json::array()}}}}}}),
              HasSubstr("there is no sample"));
  WriteFile(scratch_ / "c", "no JSON");
  EXPECT_THAT(MessageOf([&] { CompareBenchmarks({a}, {scratch_ / "c"}, false); }),
              HasSubstr("not what skein bench --json writes"));
  EXPECT_NE(MessageOf([&] { CompareBenchmarks({a}, {scratch_ / "none"}, false); }), "");
}

double SpreadOf(const std::vector<double>& samples) {
  const Figure figure{"x", true, samples};
  return ToJson(std::vector<Figure>{figure})["x"]["spread"];
}

TEST(FigureTest, TheSpreadOfFewSamplesIsThatOfMany) {
  EXPECT_EQ(SpreadOf({7}), 0);
  // By definition 8 of Hyndman and Fan the quartiles of three samples lie a sixth of the way from
  // the outer ones to the one in the middle.
  EXPECT_NEAR(SpreadOf({4, 1, 2}), 5.0 / 6 * (4 - 1) / 2, kRounding);
  constexpr double kMiddle = 100, kQuartilesOfNormal = 1.349;
  constexpr int kRuns = 20000;
  std::mt19937 generator(11);
  std::normal_distribution<double> normal(kMiddle, 1);
  for (const int count : {3, 5, 10}) {
    double sum = 0;
    for (int run = 0; run < kRuns; ++run) {
      std::vector<double> samples(static_cast<std::size_t>(count));
      for (double& sample : samples) sample = normal(generator);
      sum += kMiddle * SpreadOf(samples);
    }
    EXPECT_NEAR(sum / kRuns / kQuartilesOfNormal, 1, kBiasOfSpread) << count << " samples";
  }
}

TEST(FigureTest, PartsKeepTheOrderAndAreOfEqualLength) {
  std::vector<double> samples;
  for (int i = 0; i < 3000; ++i) samples.push_back(1 + i);
  EXPECT_EQ(MediansOfParts(samples, 3), (std::vector<double>{500.5, 1500.5, 2500.5}));
  EXPECT_EQ(MediansOfParts({3, 1, 2}, 10), (std::vector<double>{3, 1, 2}));
  const Json json = ToJson({{"x", true, samples}});
  EXPECT_EQ(json["x"]["samples"].size(), 1000u);
  EXPECT_EQ(json["x"]["median"], 1500.5);
  const std::vector<Figure> read = ReadFigures(json, "file");
  EXPECT_EQ(read.at(0).samples, MediansOfParts(samples, 1000));
  EXPECT_TRUE(read[0].more_is_better);
}

}  // namespace
}  // namespace skein
