// SPDX-License-Identifier: Apache-2.0
#include "src/run/progress.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein {
namespace {

TEST(Progress, CountsHaveThreeDigitsAndAPrefix) {
  EXPECT_EQ(FormatCount(0), "0");
  EXPECT_EQ(FormatCount(999), "999");
  EXPECT_EQ(FormatCount(1000), "1.00 k");
  EXPECT_EQ(FormatCount(999500), "1.00 M");
  EXPECT_EQ(FormatCount(12345678), "12.3 M");
  EXPECT_EQ(FormatCount(1.35e9), "1.35 G");
  EXPECT_EQ(FormatCount(491520), "492 k");
}

TEST(Progress, DurationsUseTwoUnits) {
  EXPECT_EQ(FormatDuration(0.4), "0 s");
  EXPECT_EQ(FormatDuration(59.4), "59 s");
  EXPECT_EQ(FormatDuration(725), "12 min 05 s");
  EXPECT_EQ(FormatDuration(3 * 3600 + 7 * 60), "3 h 07 min");
  EXPECT_EQ(FormatDuration(52 * 3600), "2 d 04 h");
  EXPECT_EQ(FormatDuration(std::nan("")), "-");
}

TEST(Progress, LineSaysEverything) {
  Progress progress;
  progress.env_steps = 12300000;
  progress.total_steps = 150000000;
  progress.steps_per_s = 215000;
  progress.rollout_share = 0.38;
  progress.update_share = 0.6;
  progress.return_mean = -312.04;
  progress.success_rate = 0.431;
  progress.evaluation_success_rate = 0.52;
  EXPECT_EQ(FormatProgress(progress),
            "12.3 M/150 M steps (8.2 %) | 215 k steps/s | rollout 38 % update 60 % | return -312.0 "
            "| success 43.1 % (evaluated 52.0 %) | left 10 min 40 s");
  const std::string tight = FormatProgress(progress, Spacing::kTight);
  EXPECT_EQ(tight, "12.3M/150M 215k/s return -312.0 success 43.1% left 10m40s");
}

TEST(Progress, TheTightLineFits72Columns) {
  Progress progress;
  progress.env_steps = 999e9;
  progress.total_steps = 1.35e12;
  progress.steps_per_s = 1.23e6;
  progress.return_mean = -123456.7;
  progress.success_rate = 1;
  progress.success_episodes = 49;
  EXPECT_LE(FormatProgress(progress, Spacing::kTight).size(), 72u);
}

TEST(Progress, ASuccessOfFewEpisodesSaysOfHowMany) {
  const ProgressMeter::Clock::time_point start{};
  ProgressMeter meter(0, 100, {}, start);
  IterationReport report;
  const auto line = [&](std::uint64_t episodes, double success_rate, Spacing spacing) {
    report.episodes = episodes;
    report.success_rate = success_rate;
    meter.Add(report, start);
    return FormatProgress(meter.progress(), spacing);
  };
  EXPECT_NE(line(1, 1, Spacing::kTight).find("success 100.0% of 1 left"), std::string::npos);
  EXPECT_NE(line(49, 0.5, Spacing::kWide).find("success 50.0 % of 49 |"), std::string::npos);
  // The latest that is known, of as many.
  EXPECT_NE(line(0, std::nan(""), Spacing::kWide).find("50.0 % of 49 |"), std::string::npos);
  EXPECT_NE(line(50, 0.5, Spacing::kWide).find("success 50.0 % |"), std::string::npos);
}

TEST(Progress, OfMissionsItSaysHowManyWereFlownToTheEnd) {
  const ProgressMeter::Clock::time_point start{};
  EnvConfig env;
  env.mission.training_length_s = 180;
  ProgressMeter meter(0, 100, env, start);
  IterationReport report;
  report.episodes = 50;
  report.success_rate = 0.5;
  report.evaluation_success_rate = 0.97;
  meter.Add(report, start);
  EXPECT_NE(
      FormatProgress(meter.progress()).find("| to the end 50.0 % (evaluated success 97.0 %) |"),
      std::string::npos);
  const std::string tight = FormatProgress(meter.progress(), Spacing::kTight);
  EXPECT_NE(tight.find(" to the end 50.0% left"), std::string::npos);
}

TEST(Progress, WhatIsNotKnownYetIsADash) {
  Progress progress;
  progress.total_steps = 100;
  progress.return_mean = progress.success_rate = std::nan("");
  EXPECT_EQ(FormatProgress(progress),
            "0/100 steps (0.0 %) | - steps/s | rollout 0 % update 0 % | return - | success - | "
            "left -");
}

TEST(Progress, RatesComeFromTheLastHalfMinute) {
  using std::chrono::seconds;
  const ProgressMeter::Clock::time_point start{};
  ProgressMeter meter(1000, 1000000, {}, start);
  IterationReport report;
  report.return_mean = report.success_rate = std::nan("");
  // A slow start of 100 steps/s, then 1000 steps/s with a quarter of the time in rollouts.
  report.env_steps = 2000;
  report.rollout_seconds = 9;
  meter.Add(report, start + seconds(10));
  EXPECT_DOUBLE_EQ(meter.progress().steps_per_s, 100);
  EXPECT_DOUBLE_EQ(meter.progress().rollout_share, 0.9);
  for (int i = 1; i <= 10; ++i) {
    report.env_steps += 10000;
    report.rollout_seconds = 2.5;
    report.update_seconds = 7.5;
    meter.Add(report, start + seconds(10 + 10 * i));
  }
  EXPECT_DOUBLE_EQ(meter.progress().steps_per_s, 1000);
  EXPECT_DOUBLE_EQ(meter.progress().rollout_share, 0.25);
  EXPECT_DOUBLE_EQ(meter.progress().update_share, 0.75);
  EXPECT_TRUE(std::isnan(meter.progress().return_mean));
}

TEST(Progress, RatesAreOfNoLessThanHalfAMinute) {
  using std::chrono::seconds;
  const ProgressMeter::Clock::time_point start{};
  ProgressMeter meter(0, 10000000, {}, start);
  IterationReport report;
  // Two iterations of 20 s each, a slow and a quick one, are the fewest that last so long.
  for (int i = 1; i <= 8; ++i) {
    report.env_steps += i % 2 == 0 ? 60000 : 20000;
    meter.Add(report, start + seconds(20 * i));
    EXPECT_DOUBLE_EQ(meter.progress().steps_per_s, i == 1 ? 1000 : 2000) << i;
  }
}

TEST(Progress, NothingIsLeftOfABudgetThatIsFlown) {
  Progress progress;
  progress.total_steps = 1000;
  progress.steps_per_s = 10;
  progress.env_steps = 600;
  EXPECT_EQ(SecondsLeft(progress), 40);
  for (const std::uint64_t flown : {1000u, 1001u}) {
    progress.env_steps = flown;
    EXPECT_EQ(SecondsLeft(progress), 0) << flown;
  }
}

TEST(Progress, LatestKnownValuesStay) {
  const ProgressMeter::Clock::time_point start{};
  ProgressMeter meter(0, 100, {}, start);
  IterationReport report;
  report.env_steps = 10;
  report.return_mean = -5;
  report.success_rate = 0.5;
  report.evaluation_success_rate = 0.75;
  meter.Add(report, start + std::chrono::seconds(1));
  report.return_mean = report.success_rate = std::nan("");
  report.evaluation_success_rate = -1;
  meter.Add(report, start + std::chrono::seconds(2));
  EXPECT_EQ(meter.progress().return_mean, -5);
  EXPECT_EQ(meter.progress().success_rate, 0.5);
  EXPECT_EQ(meter.progress().evaluation_success_rate, 0.75);
}

}  // namespace
}  // namespace skein
