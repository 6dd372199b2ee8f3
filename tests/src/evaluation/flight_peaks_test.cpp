// SPDX-License-Identifier: Apache-2.0
// Peaks of flights, against the same flights recorded step by step.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "envs/aircraft/aircraft.h"
#include "envs/autopilot/autopilot.h"
#include "src/evaluation/flight_summary.h"
#include "src/evaluation/flight_table.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr int kEpisodes = 24;
constexpr Tolerance kAngles{2e-4, "float32 kernels of a few ULP, in degrees up to 180"};
constexpr Tolerance kMeans{2e-6, "float32 rounding of a mean, relative"};

EnvConfig Windy() {
  EnvConfig env;
  env.task = "heading";
  env.time_limit_steps = 1200;
  env.wind.speed_fps = {0, 60};
  env.wind.turbulence_fps = {0, 8};
  return env;
}

EnvConfig Held() {
  EnvConfig env = Windy();
  env.hold_s = 3;
  return env;
}

EnvConfig Mission() {
  EnvConfig env = Windy();
  env.mission.length_s = 30;
  return env;
}

/// One that brings the aircraft to its targets, and one that loses many.
std::vector<Agent> TwoAgents(const EnvConfig& env) {
  return {Agent::Of(MakeAutopilot(env, AutopilotVariant::kAggressive)), Agent::Random(25)};
}

std::vector<Episode> Fly(const Agent& agent, const EnvConfig& env, int threads) {
  WorkerPool pool(threads);
  EvaluationOptions options;
  options.episodes = kEpisodes;
  options.flight_metrics = true;
  return FlyEpisodes(agent, agent.EnvironmentFor(env), options, pool).episodes;
}

std::vector<FlightTable> Record(const Agent& agent, const EnvConfig& env) {
  WorkerPool pool(2);
  EvaluationOptions options;
  options.episodes = kEpisodes;
  const AgentFlights recorded =
      FlyAndRecord("agent", agent, agent.EnvironmentFor(env), options, kEpisodes, pool);
  std::vector<FlightTable> tables;
  for (const RecordedFlight& flight : recorded.flights) {
    tables.push_back(TableOf(recorded.env, flight));
  }
  return tables;
}

/// The lowest and the highest of a column after the initial state.
std::pair<double, double> RangeOf(const FlightTable& table, const std::string& name) {
  const std::vector<double>& column = table.Column(name);
  const auto [low, high] = std::minmax_element(column.begin() + 1, column.end());
  return {*low, *high};
}

double PeakOfAbs(const FlightTable& table, const std::string& name) {
  const auto [low, high] = RangeOf(table, name);
  return std::max(std::abs(low), std::abs(high));
}

TEST(FlightPeaksTest, AreThoseOfTheRecordedStepsToTheEndOfHoldsAndMissions) {
  for (const EnvConfig& env : {Windy(), Held(), Mission()}) {
    for (const Agent& agent : TwoAgents(env)) {
      const std::vector<Episode> flown = Fly(agent, env, 2);
      const std::vector<FlightTable> tables = Record(agent, env);
      ASSERT_EQ(tables.size(), flown.size());
      for (std::size_t i = 0; i < flown.size(); ++i) {
        const auto& metrics = flown[i].metrics;
        ASSERT_EQ(static_cast<std::int32_t>(tables[i].rows()) - 1, flown[i].steps);
        const auto [lowest, highest] = RangeOf(tables[i], "load_factor_g");
        EXPECT_EQ(metrics[kPeakLoadFactor], highest);
        EXPECT_EQ(metrics[kLowestLoadFactor], lowest);
        EXPECT_NEAR(metrics[kPeakAlpha], RangeOf(tables[i], "alpha_deg").second, kAngles);
        EXPECT_NEAR(metrics[kPeakAbsBeta], PeakOfAbs(tables[i], "beta_deg"), kAngles);
        EXPECT_NEAR(metrics[kPeakAbsP], PeakOfAbs(tables[i], "p_deg_s"), kAngles);
      }
    }
  }
}

TEST(FlightPeaksTest, LieBeyondTheMeans) {
  for (const EnvConfig& env : {Windy(), Held()}) {
    for (const Agent& agent : TwoAgents(env)) {
      for (const Episode& episode : Fly(agent, env, 2)) {
        const auto at_least = [&](double peak, double mean) {
          EXPECT_GE(peak, mean - kMeans * std::abs(mean));
        };
        const auto& metrics = episode.metrics;
        at_least(metrics[kPeakLoadFactor], metrics[kMeanLoadFactor]);
        at_least(metrics[kMeanLoadFactor], metrics[kLowestLoadFactor]);
        at_least(metrics[kPeakAbsBeta], metrics[kMeanAbsBeta]);
        at_least(metrics[kPeakAbsP], metrics[kMeanAbsP] * kDegPerRad);
        EXPECT_GT(metrics[kPeakLoadFactor], metrics[kLowestLoadFactor]) << "gusts alone move it";
      }
    }
  }
}

TEST(FlightPeaksTest, OfAHoldAreAtLeastThoseOfReachingTheTarget) {
  // What is flown until the target is reached is the same with and without a hold behind it.
  const Agent autopilot = TwoAgents(Windy()).front();
  const std::vector<Episode> plain = Fly(autopilot, Windy(), 2), held = Fly(autopilot, Held(), 2);
  int longer = 0;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    longer += held[i].steps > plain[i].steps;
    EXPECT_LE(held[i].metrics[kLowestLoadFactor], plain[i].metrics[kLowestLoadFactor]);
    for (const int k : {kPeakLoadFactor, kPeakAlpha, kPeakAbsBeta, kPeakAbsP}) {
      EXPECT_GE(held[i].metrics[k], plain[i].metrics[k]) << kFlightMetricNames[k].key;
    }
  }
  EXPECT_GT(longer, kEpisodes / 4);
}

TEST(FlightPeaksTest, DoNotDependOnThreads) {
  for (const Agent& agent : TwoAgents(Held())) {
    const std::vector<Episode> one = Fly(agent, Held(), 1), three = Fly(agent, Held(), 3);
    for (std::size_t i = 0; i < one.size(); ++i) {
      for (int k = kFirstPeak; k < kNumFlightMetrics; ++k) {
        EXPECT_EQ(one[i].metrics[k], three[i].metrics[k]) << kFlightMetricNames[k].key;
      }
    }
  }
}

TEST(FlightPeaksTest, TheWorstFlightStandsBehindTheMeanForPeople) {
  const Agent autopilot = TwoAgents(Held()).front();
  const FlightSummary summary = SummariseFlights(Fly(autopilot, Held(), 2), Held());
  const auto peak = std::find_if(summary.quantities.begin(), summary.quantities.end(),
                                 [](const Quantity& q) { return q.key == "lowest_load_factor_g"; });
  ASSERT_NE(peak, summary.quantities.end());
  const auto k = static_cast<std::size_t>(peak - summary.quantities.begin());
  const std::string mean = FormatEstimate(*peak, summary.estimates[k]);
  const std::string worst = FormatEstimate(*(peak + 1), summary.estimates[k + 1]);
  EXPECT_NE(mean.find(" +- "), std::string::npos) << mean;
  EXPECT_EQ(FormatFigure(summary, k), mean + " (" + worst + ")");
  const std::string text = FormatFlightMetrics(summary);
  EXPECT_NE(text.find("peaks (worst flight):\n  peak nz, g"), std::string::npos) << text;
  EXPECT_EQ(text.find("worst flight's"), std::string::npos) << "in rows of their own: " << text;
  EXPECT_NE(text.find(mean + " (" + worst + ")"), std::string::npos) << text;
  // Of flights that all ended as non_finite there is nothing to say.
  Episode lost;
  lost.termination = Termination::kNonFinite;
  lost.steps = 1;
  lost.metrics.fill(std::nanf(""));
  EXPECT_EQ(FormatFigure(SummariseFlights({lost}, Held()), k), "-");
}

}  // namespace
}  // namespace skein
