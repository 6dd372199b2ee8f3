// SPDX-License-Identifier: Apache-2.0
#include "src/evaluation/quantities.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/tolerance.h"

namespace skein {
namespace {

std::vector<std::string> LabelsOf(const EnvConfig& env) {
  std::vector<std::string> labels;
  for (const Quantity& quantity : QuantitiesOf(env)) labels.push_back(quantity.label);
  return labels;
}

constexpr double kInterval_s = 0.02;
constexpr Tolerance kRounding{1e-12, "a few roundings of float64"};

Estimate EstimateOf(const std::string& key, const EnvConfig& env,
                    const std::vector<Episode>& episodes) {
  const std::vector<Quantity> quantities = QuantitiesOf(env);
  const auto found = std::find_if(quantities.begin(), quantities.end(),
                                  [&key](const Quantity& quantity) { return quantity.key == key; });
  EXPECT_NE(found, quantities.end()) << key;
  return EstimateOf(*found, episodes, kInterval_s);
}

Episode Flight(Termination termination, double minutes) {
  Episode episode;
  episode.termination = termination;
  episode.steps = static_cast<std::int32_t>(std::lround(minutes * 60 / kInterval_s));
  return episode;
}

EnvConfig Missions() {
  EnvConfig env;
  env.mission.length_s = 600;
  return env;
}

TEST(QuantitiesOf, TargetsPerMinuteAreOfTheTimeThatWasFlown) {
  Episode whole = Flight(Termination::kTimeLimit, 10), lost = Flight(Termination::kLowAltitude, 2);
  whole.measures.targets_reached = 30;
  lost.measures.targets_reached = 2;
  EXPECT_NEAR(EstimateOf("targets_per_minute", Missions(), {whole, lost}).value, (3 + 1) / 2.0,
              kRounding);
}

TEST(QuantitiesOf, LossesAreOfAllHoursFlown) {
  std::vector<Episode> flights(11, Flight(Termination::kTimeLimit, 10));
  flights.push_back(Flight(Termination::kLowAltitude, 6));
  flights.push_back(Flight(Termination::kNonFinite, 4));
  EXPECT_NEAR(EstimateOf("losses_per_hour", Missions(), flights).value, 2 / 2.0, kRounding);
  EXPECT_EQ(EstimateOf("losses_per_hour", Missions(), flights).count, 2);
}

TEST(QuantitiesOf, WhatNeverReachedItsTargetIsNotLostWhileHoldingIt) {
  EnvConfig held;
  held.hold_s = 30;
  Episode kept = Flight(Termination::kTargetReached, 1),
          lost = Flight(Termination::kLowAltitude, 1);
  kept.reached_step = lost.reached_step = 100;
  const Episode never = Flight(Termination::kLowAltitude, 1);
  const Estimate share = EstimateOf("hold_lost", held, {kept, kept, kept, lost, never, never});
  EXPECT_EQ(share.value, 1 / 4.0);
  EXPECT_EQ(share.count, 4);
}

TEST(QuantitiesOf, TheTimeToATargetIsUntilItsTolerancesWereEnteredThatWereHeld) {
  EnvConfig dwelt;
  dwelt.heading.dwell_s = 3;
  Episode reached = Flight(Termination::kTargetReached, 1);
  reached.entered_step = 500;
  reached.reached_step = 650;
  const Episode missed = Flight(Termination::kTimeLimit, 1);
  EXPECT_NEAR(EstimateOf("time_to_target_s", dwelt, {reached, missed}).value, 10, kRounding);
  EXPECT_NEAR(EstimateOf("time_held_s", dwelt, {reached, missed}).value, 13, kRounding);
}

TEST(QuantitiesOf, PeaksAreMeansAndTheWorstOfThoseThatHaveThem) {
  std::vector<Episode> flights(4, Flight(Termination::kTimeLimit, 1));
  for (std::size_t i = 0; i < 3; ++i) {
    const std::array<float, 3> highest = {3, 7, 5}, lowest = {0.5f, 1, -1.5f};
    flights[i].metrics[kPeakLoadFactor] = highest[i];
    flights[i].metrics[kLowestLoadFactor] = lowest[i];
    flights[i].metrics[kPeakAlpha] = -highest[i];
  }
  flights[3].termination = Termination::kNonFinite;
  flights[3].metrics.fill(std::nanf(""));
  const auto estimate = [&](const char* key) { return EstimateOf(key, EnvConfig(), flights); };
  EXPECT_NEAR(estimate("peak_load_factor_g").value, 5, kRounding);
  EXPECT_EQ(estimate("peak_load_factor_g").count, 3);
  EXPECT_EQ(estimate("peak_load_factor_g_worst").value, 7);
  EXPECT_EQ(estimate("peak_load_factor_g_worst").count, 3);
  EXPECT_TRUE(std::isnan(estimate("peak_load_factor_g_worst").low)) << "no interval";
  EXPECT_NEAR(estimate("lowest_load_factor_g").value, 0, kRounding);
  EXPECT_EQ(estimate("lowest_load_factor_g_worst").value, -1.5) << "the lowest of all";
  EXPECT_EQ(estimate("peak_alpha_deg_worst").value, -3) << "the highest, though below 0";
  flights.erase(flights.begin(), flights.begin() + 3);
  EXPECT_TRUE(std::isnan(estimate("peak_load_factor_g_worst").value)) << "nobody has one";
  EXPECT_EQ(estimate("peak_load_factor_g_worst").count, 0);
}

TEST(QuantitiesOf, PeaksStandBehindAllOtherColumnsWhateverIsFlown) {
  EnvConfig held;
  held.hold_s = 30;
  for (const EnvConfig& env : {EnvConfig(), held, Missions()}) {
    const std::vector<Quantity> quantities = QuantitiesOf(env);
    const auto is_peak = [](const Quantity& quantity) {
      return quantity.section == QuantitySection::kPeaks;
    };
    const auto first = std::find_if(quantities.begin(), quantities.end(), is_peak);
    EXPECT_EQ(quantities.end() - first, 2 * (kNumFlightMetrics - kFirstPeak));
    EXPECT_TRUE(std::all_of(first, quantities.end(), is_peak));
    // Each is followed by the worst flight's.
    for (auto mean = first; mean != quantities.end(); mean += 2) {
      EXPECT_EQ((mean + 1)->key, mean->key + "_worst");
      EXPECT_EQ(mean->statistic, Statistic::kMean);
    }
  }
}

TEST(QuantitiesOf, MissionsOfTrainingAreNotThoseOfEvaluations) {
  EnvConfig points;
  points.task = "tracking";
  EnvConfig trained = points;
  trained.mission.training_length_s = 60;
  EXPECT_EQ(LabelsOf(trained), LabelsOf(points));
  EnvConfig missions = points;
  missions.mission.length_s = 60;
  EXPECT_NE(LabelsOf(missions), LabelsOf(points));
}

}  // namespace
}  // namespace skein
