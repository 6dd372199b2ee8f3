// SPDX-License-Identifier: Apache-2.0
#include "src/config/target_reach.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "envs/task_registry.h"
#include "src/config/configuration.h"

namespace skein {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> Beyond(const std::string& task,
                                const std::vector<std::string>& assignments,
                                const std::vector<std::string>& conditions = {}) {
  return AltitudesBeyondTables(
      ResolveConfig({task, "default", "", assignments, conditions}).train.env);
}

const std::string kEnd =
    " ft: the engine's tables end at 50000 ft, and thrust above is held as there";

TEST(AltitudesBeyondTables, AreNamedOfStartsAndTargets) {
  EXPECT_THAT(Beyond("heading", {}, {"high_altitude=47000ft"}), IsEmpty());
  EXPECT_THAT(Beyond("heading", {}, {"high_altitude=40..48kft"}),
              ElementsAre("the target altitude is at up to 51000" + kEnd));
  EXPECT_THAT(Beyond("heading", {"env.heading.altitude_change_ft=50000"}),
              ElementsAre("the target altitude is at up to 70000" + kEnd));
  EXPECT_THAT(Beyond("heading", {"env.target_altitude_min_ft=55000"}),
              ElementsAre("the target altitude is at up to 55000" + kEnd));
  EXPECT_THAT(Beyond("control", {}, {"high_altitude=60"}),
              ElementsAre("flights begin at up to 60000" + kEnd));
  EXPECT_THAT(
      Beyond("tracking", {"env.tracking.distance_max_ft=60000", "env.tracking.elevation_deg=90"}),
      ElementsAre("the target is at up to 80000" + kEnd));
}

TEST(AltitudesBeyondTables, AreNamedOfTaskFiles) {
  EnvConfig env;
  TermTaskConfig task;
  task.targets.resize(3);
  task.targets[0].name = "altitude";
  task.targets[0].quantity.value = TermValue::kAltitude;
  task.targets[0].draw_from = TermTarget::Draw::kBetween;
  task.targets[0].draw = {40000, 52000};
  task.targets[1].name = "point";
  task.targets[1].draw_from = TermTarget::Draw::kPoint;
  task.targets[1].distance_ft = {0, 80000};
  task.targets[1].elevation_deg = 30;
  task.targets[2].name = "speed";
  task.targets[2].quantity.value = TermValue::kTrueAirspeed;
  task.targets[2].draw = {0, 60000};
  env.SetTermTask(task);
  EXPECT_THAT(AltitudesBeyondTables(env), ElementsAre("target altitude is at up to 52000" + kEnd,
                                                      "target point is at up to 60000" + kEnd));
}

TEST(AltitudesBeyondTables, AreThoseOfTheAircraft) {
  EnvConfig env;
  env.aircraft = "cessna172";
  EXPECT_FALSE(AltitudesBeyondTables(env).empty()) << "an F-16's 20,000 ft";
  for (const char* aircraft : {"aerosonde", "cessna172"}) {
    EXPECT_THAT(AltitudesBeyondTables(ResolveConfig({"heading", aircraft, "", {}}).train.env),
                IsEmpty());
  }
}

// From 45,000 ft Tracking's points, up to 30,000 ft away, lie up to 15,000 ft higher.
TEST(AltitudesBeyondTables, AreNamedOfTheHardLevelForTrackingAlone) {
  for (const std::string& task : TaskNames()) {
    EXPECT_EQ(Beyond(task, {}, {"high_altitude=hard"}).empty(), task != "tracking") << task;
    EXPECT_THAT(Beyond(task, {}), IsEmpty()) << task;
  }
}

}  // namespace
}  // namespace skein
