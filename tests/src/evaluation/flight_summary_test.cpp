// SPDX-License-Identifier: Apache-2.0
#include "src/evaluation/flight_summary.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace skein {
namespace {

Episode EndedBy(Termination termination) {
  Episode episode;
  episode.termination = termination;
  episode.steps = 100;
  return episode;
}

std::string EndsOf(const std::vector<Episode>& episodes, const EnvConfig& env) {
  return FormatEnds(SummariseFlights(episodes, env));
}

TEST(FlightSummaryTest, EndsAreCountedByKind) {
  const Episode late = EndedBy(Termination::kTimeLimit);
  const Episode there = EndedBy(Termination::kTargetReached);
  EXPECT_EQ(EndsOf({late, there, there}, {}), "ended by target_reached 2, time_limit 1");
}

TEST(FlightSummaryTest, AMissionIsFlownWhenItsTimeIsOver) {
  EXPECT_TRUE(IsMissionFlown(true, "time_limit"));
  EXPECT_FALSE(IsMissionFlown(true, "overload"));
  EXPECT_FALSE(IsMissionFlown(true, "")) << "in flight";
  EXPECT_FALSE(IsMissionFlown(false, "time_limit"));
}

TEST(FlightSummaryTest, OfMissionsOnlyLossesAreEnds) {
  EnvConfig env;
  env.mission.length_s = 600;
  const Episode whole = EndedBy(Termination::kTimeLimit);
  const Episode low = EndedBy(Termination::kLowAltitude), pulled = EndedBy(Termination::kOverload);
  EXPECT_EQ(EndsOf({whole, low, whole, pulled, low}, env), "lost by low_altitude 2, overload 1");
  EXPECT_EQ(EndsOf({whole, whole}, env), "") << "all are flown to their end";
}

TEST(FlightSummaryTest, MissionsOfTrainingAreNotThoseOfEvaluations) {
  EnvConfig env;  // as of Tracking's default preset
  env.mission.training_length_s = 180;
  const Episode late = EndedBy(Termination::kTimeLimit);
  const Episode there = EndedBy(Termination::kTargetReached);
  EXPECT_EQ(EndsOf({there, late}, env), "ended by target_reached 1, time_limit 1");
}

}  // namespace
}  // namespace skein
