// SPDX-License-Identifier: Apache-2.0
#include "src/config/target_reach.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "envs/aircraft/registry.h"
#include "envs/task_registry.h"
#include "src/config/configuration.h"
#include "src/files/output_file.h"
#include "tests/scratch_directory.h"

namespace skein {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

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

TEST(AltitudesBeyondTables, AreNamedOfWhatIsGivenInThePlaceOfADraw) {
  EnvConfig env;
  env.initial.altitude_ft = {51000, 51000};
  const std::string start = "flights begin at up to 51000" + kEnd;
  EXPECT_THAT(AltitudesBeyondTables(env, {{"altitude_ft", 50000}, {"yaw_deg", 90000}}),
              ElementsAre(start));
  EXPECT_THAT(AltitudesBeyondTables(env, {{"altitude_ft", 55000}}),
              ElementsAre(start, "the target altitude is at up to 55000" + kEnd));
  env.task = "tracking";
  EXPECT_THAT(AltitudesBeyondTables(env, {{"altitude_ft", 50000}}), ElementsAre(start));
  EXPECT_THAT(AltitudesBeyondTables(env, {{"altitude_ft", 55000}}),
              ElementsAre(start, "the target is at up to 55000" + kEnd));
  env.task = "control";
  EXPECT_THAT(AltitudesBeyondTables(env, {{"pitch_deg", 90}}), ElementsAre(start));
}

TEST(WindsBeyondAirspeed, AreNamedWhereTheyAreMetAsAStep) {
  const auto beyond = [](const std::vector<std::string>& conditions,
                         const std::vector<std::string>& assignments = {}) {
    const ProgramConfig begun_at_75_fps =
        ResolveConfig({"heading", "aerosonde", "", assignments, conditions});
    return WindsBeyondAirspeed(begun_at_75_fps.train.env);
  };
  EXPECT_THAT(beyond({"windy=hard"}),
              ElementsAre("winds of up to 200 ft/s met as a step at 75 ft/s: flights may end as "
                          "they begin"));
  EXPECT_THAT(beyond({"windy=75fps"}), SizeIs(1));
  EXPECT_THAT(beyond({"windy=74fps"}), IsEmpty());
  EXPECT_THAT(beyond({"windy=hard"}, {"env.wind.step_at_reset=false"}), IsEmpty());
}

TEST(TargetsBeyondLimits, AreNamedOfWhatIsGivenInThePlaceOfADraw) {
  EnvConfig env;
  TermTaskConfig task;
  task.targets.resize(3);
  task.targets[0].name = "height";
  task.targets[0].quantity.name = "altitude_ft";
  task.targets[0].quantity.value = TermValue::kAltitude;
  task.targets[0].draw_from = TermTarget::Draw::kBetween;
  task.targets[0].draw = {100, 200};
  task.targets[1].name = "speed";
  task.targets[1].quantity.name = "true_airspeed_fps";
  task.targets[1].quantity.value = TermValue::kTrueAirspeed;
  task.targets[2].name = "number";
  task.targets[2].quantity.name = "mach";
  task.targets[2].quantity.value = TermValue::kMach;
  task.targets[2].draw_from = TermTarget::Draw::kBetween;
  task.targets[2].draw = {0.8, 0.9};
  env.SetTermTask(task);
  const std::string low =
      "target height cannot be reached: it is 200 or less (altitude_ft), but flights end below "
      "2500 ft (env.termination.min_altitude_ft)";
  EXPECT_THAT(TargetsBeyondLimits(env), ElementsAre(low));
  EXPECT_THAT(TargetsBeyondLimits(env, {{"altitude_ft", 2500}}), IsEmpty());
  EXPECT_THAT(TargetsBeyondLimits(env, {{"true_airspeed_fps", 1000}}), ElementsAre(low));
  env.termination.max_mach = 1;
  EXPECT_THAT(TargetsBeyondLimits(env, {{"altitude_ft", 9000}, {"true_airspeed_fps", 2000}}),
              ElementsAre("target speed cannot be reached: it is 2000 (true_airspeed_fps), but "
                          "flights end above Mach 1 (env.termination.max_mach)"));
  EXPECT_THAT(TargetsBeyondLimits(env, {{"altitude_ft", 9000}, {"mach", 1.5}}),
              ElementsAre("target number cannot be reached: it is 1.5 (mach), but flights "
                          "end above Mach 1 (env.termination.max_mach)"));
}

TEST(TargetsBeyondLimits, AnglesOfMoreThanATurnAreNamed) {
  EnvConfig env;
  EXPECT_THAT(TargetsBeyondLimits(env, {{"yaw_deg", -350}, {"pitch_deg", 80}}), IsEmpty());
  EXPECT_THAT(TargetsBeyondLimits(env, {{"yaw_deg", -4000}}),
              ElementsAre("target yaw_deg is -4000, more than a turn: it is flown to modulo 360"));
  TermTaskConfig task;
  task.targets.resize(1);
  task.targets[0].name = "bank";
  task.targets[0].quantity.name = "roll_deg";
  task.targets[0].quantity.value = TermValue::kRoll;
  task.targets[0].quantity.per_value = 180 / M_PI;
  task.targets[0].draw = {-M_PI, M_PI};
  env.SetTermTask(task);
  EXPECT_THAT(TargetsBeyondLimits(env), IsEmpty());
  task.targets[0].draw = {-10, 10};
  env.SetTermTask(task);
  EXPECT_THAT(
      TargetsBeyondLimits(env),
      ElementsAre("target bank is up to 572.96, more than a turn: it is flown to modulo 360"));
}

TEST(TargetsBeyondLimits, AreNamedOfWhatIsGivenToABuiltInTask) {
  EnvConfig env;
  EXPECT_THAT(TargetsBeyondLimits(env), IsEmpty());
  EXPECT_THAT(TargetsBeyondLimits(env, {{"altitude_ft", 2500}, {"yaw_deg", 90}}), IsEmpty());
  EXPECT_THAT(TargetsBeyondLimits(env, {{"altitude_ft", 1000}, {"yaw_deg", 90}}),
              ElementsAre("target altitude_ft cannot be reached: it is 1000, "
                          "but flights end below 2500 ft (env.termination.min_altitude_ft)"));
  env.termination.max_mach = 1;
  EXPECT_THAT(TargetsBeyondLimits(env, {{"true_airspeed_fps", 2000}}),
              ElementsAre("target true_airspeed_fps cannot be reached: it is 2000, but "
                          "flights end above Mach 1 (env.termination.max_mach)"));
}

TEST(AltitudesBeyondTables, OfTablesInMetresEndAtTheFeetOfThem) {
  const ScratchDirectory scratch;
  auto file = nlohmann::json::parse(AircraftText("cessna172"));
  file["propulsion"]["max_altitude_m"] = 6096;
  EnvConfig env;
  env.task = "control";
  env.aircraft = scratch / "high.json";
  WriteFile(env.aircraft, file.dump());
  ASSERT_LT(LoadAircraft(env.aircraft).engine.altitude_ft.back(), 20000) << "by rounding alone";
  env.initial.altitude_ft = {20000, 20000};
  EXPECT_THAT(AltitudesBeyondTables(env), IsEmpty());
  env.initial.altitude_ft.max = 20001;
  EXPECT_THAT(AltitudesBeyondTables(env),
              ElementsAre("flights begin at up to 20001 ft: the engine's tables end at 20000 ft, "
                          "and thrust above is held as there"));
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
