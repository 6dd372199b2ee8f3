// SPDX-License-Identifier: Apache-2.0
#include "src/config/conditions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/field_list.h"
#include "base/number_text.h"
#include "envs/task_registry.h"
#include "envs/vec_env.h"
#include "src/config/configuration.h"
#include "src/files/output_file.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

std::string Complaint(const std::vector<std::string>& conditions) {
  try {
    ConditionAssignments(conditions);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

EnvConfig Under(const std::vector<std::string>& conditions, const std::string& task = "heading") {
  const ProgramConfig config = ResolveConfig({task, "default", "", {}, conditions});
  CheckConsistent(config);
  return config.train.env;
}

/// The rows of the table of docs/reference/conditions.md whose head begins with "| HEAD |", as
/// their cells.
std::vector<std::vector<std::string>> TableOfPage(const std::string& head) {
  std::istringstream page(ReadFile(SKEIN_SOURCE "/docs/reference/conditions.md"));
  std::vector<std::vector<std::string>> rows;
  bool is_in_table = false;
  for (std::string line; std::getline(page, line);) {
    is_in_table =
        line.rfind("| " + head + " |", 0) == 0 || (is_in_table && line.rfind('|', 0) == 0);
    if (!is_in_table) continue;
    std::istringstream cells(line.substr(2));
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, '|');) {
      const std::size_t end = cell.find_last_not_of(' ') + 1, begin = cell.find_first_not_of(' ');
      if (begin < end) rows.back().push_back(cell.substr(begin, end - begin));
    }
  }
  if (rows.size() > 2) rows.erase(rows.begin(), rows.begin() + 2);  // the head and the line below
  return rows;
}

/// The names in a cell: what stands between backquotes.
std::vector<std::string> NamesIn(const std::string& cell) {
  std::vector<std::string> names;
  std::istringstream parts(cell);
  std::string part;
  while (std::getline(parts, part, '`') && std::getline(parts, part, '`')) names.push_back(part);
  return names;
}

/// "A", "A to B" or "A..B" of a page.
Range RangeIn(const std::string& cell) {
  for (const std::string between : {" to ", ".."}) {
    const std::size_t at = cell.find(between);
    if (at == std::string::npos) continue;
    return {std::stod(cell.substr(0, at)), std::stod(cell.substr(at + between.size()))};
  }
  return {std::stod(cell), std::stod(cell)};
}

/// The same or "+-X", to either side of the nominal value, or "+-X %" of it.
Range RangeAround(double nominal, const std::string& cell) {
  if (cell.rfind("+-", 0) != 0) return RangeIn(cell);
  const double half_width = std::stod(cell.substr(2)) / (cell.back() == '%' ? 100 : 1);
  return {nominal - half_width, nominal + half_width};
}

void ExpectRange(const Range& is, const Range& expected, const std::string& of) {
  EXPECT_DOUBLE_EQ(is.min, expected.min) << of;
  EXPECT_DOUBLE_EQ(is.max, expected.max) << of;
}

/// By their keys: "mass_min".
std::map<std::string, double> ValuesOf(PlantConfig plant) {
  std::map<std::string, double> values;
  for (const Field& field : FieldsOf(plant)) {
    values[field.key] = NumberOf(field.ValueText(ShortestText)).value();
  }
  return values;
}

/// Of the keys of a quantity, those of its least and greatest value; one of what is no range.
std::vector<std::string> KeysOf(const std::string& quantity) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : ValuesOf({})) {
    const bool is_end =
        key.rfind(quantity + "_min", 0) == 0 || key.rfind(quantity + "_max", 0) == 0;
    if (is_end || key == quantity) keys.push_back(key);
  }
  return keys;
}

const std::vector<std::string> kLevels = {"mild", "middle", "hard"};

/// Of all but plant: what the level sets is what the page says of it.
void ExpectLevel(const std::string& condition, const std::string& level, const std::string& cell) {
  const std::string text = condition + "=" + level;
  const EnvConfig env = Under({text});
  if (condition == "windy") {
    const std::size_t comma = cell.find("fps,");
    ASSERT_NE(comma, std::string::npos) << cell;
    ExpectRange(env.wind.speed_fps, RangeIn(cell.substr(0, comma)), text);
    double deviation_fps = 0;
    for (const auto& row : TableOfPage("severity")) {
      if (row[0] == cell.substr(comma + 4)) deviation_fps = std::stod(row[1]);
    }
    ExpectRange(env.wind.turbulence_fps, {deviation_fps, deviation_fps}, text);
    return;
  }
  const Range range = RangeIn(cell);
  if (condition == "noisy") {
    EXPECT_EQ(env.observation_noise, range.min) << text;
    EXPECT_EQ(env.most_noise(), 0) << text;
  } else if (condition == "high_altitude") {
    ExpectRange(env.initial.altitude_ft, {1000 * range.min, 1000 * range.max}, text);
  } else {
    constexpr double kFpsOfMachOne = 1037;  // by the page
    ExpectRange(env.initial.true_airspeed_fps,
                {kFpsOfMachOne * range.min, kFpsOfMachOne * range.max}, text);
  }
}

TEST(Conditions, LevelsAreThoseOfThePage) {
  std::vector<std::string> names;
  for (const auto& row : TableOfPage("condition")) {
    ASSERT_EQ(row.size(), 3 + kLevels.size());
    names.push_back(NamesIn(row[0]).at(0));
    for (std::size_t k = 0; k < kLevels.size(); ++k) {
      if (names.back() != "plant") {
        ExpectLevel(names.back(), kLevels[k], row[3 + k]);
        continue;
      }
      EXPECT_EQ(ConditionAssignments({"plant=" + kLevels[k]}),
                ConditionAssignments({"plant=" + row[3 + k]}));
    }
  }
  EXPECT_THAT(Complaint({"all=mild"}), EndsWith(fmt::format("known: {}", fmt::join(names, ", "))));
}

TEST(Conditions, LevelsOfThePlantAreThoseOfThePage) {
  const std::map<std::string, double> nominal = ValuesOf({});
  for (std::size_t k = 0; k < kLevels.size(); ++k) {
    std::map<std::string, double> left = ValuesOf(Under({"plant=" + kLevels[k]}).plant);
    for (const auto& row : TableOfPage("quantity")) {
      ASSERT_EQ(row.size(), 2 + kLevels.size());
      for (const std::string& quantity : NamesIn(row[0])) {
        const std::vector<std::string> keys = KeysOf(quantity);
        ASSERT_FALSE(keys.empty()) << quantity;
        const Range expected = RangeAround(nominal.at(keys[0]), row[2 + k]);
        for (const std::string& key : keys) {
          ASSERT_EQ(left.count(key), 1u) << key << " is there twice";
          const bool is_max = key.find("_max") != std::string::npos;
          EXPECT_DOUBLE_EQ(left[key], is_max ? expected.max : expected.min)
              << key << " of " << kLevels[k];
          left.erase(key);
        }
      }
    }
    // When a sensor freezes is no matter of levels.
    EXPECT_EQ(left, (std::map<std::string, double>{{"sensor_freeze_min_s", 5},
                                                   {"sensor_freeze_max_s", 30}}));
  }
}

TEST(Conditions, AreConfigurationAssignments) {
  EXPECT_THAT(ConditionAssignments({}), ElementsAre());
  EXPECT_THAT(
      ConditionAssignments({"high_altitude=30..35kft"}),
      ElementsAre("env.initial.altitude_min_ft=30000", "env.initial.altitude_max_ft=35000",
                  "env.target_altitude_min_ft=0", "env.initial.training_altitude_min_ft=0",
                  "env.initial.training_true_airspeed_min_fps=0", "env.atmosphere=standard_1976"));
  EXPECT_THAT(
      ConditionAssignments({"high_altitude=32500ft"}),
      ElementsAre("env.initial.altitude_min_ft=32500", "env.initial.altitude_max_ft=32500",
                  "env.target_altitude_min_ft=0", "env.initial.training_altitude_min_ft=0",
                  "env.initial.training_true_airspeed_min_fps=0", "env.atmosphere=standard_1976"));
  EXPECT_THAT(ConditionAssignments({"noisy=0.03"}),
              ElementsAre("env.observation_noise=0.03", "env.observation_noise_max=0",
                          "env.training_noise_max=0"));
  EXPECT_THAT(ConditionAssignments({"noisy=0.01..0.05"}),
              ElementsAre("env.observation_noise=0.01", "env.observation_noise_max=0.05",
                          "env.training_noise_max=0"));
}

TEST(Conditions, WindIsThatOfTrainingToo) {
  const std::vector<std::string> assignments = ConditionAssignments({"windy=60fps"});
  EXPECT_THAT(assignments, Contains("env.wind.training_speed_max_fps=0"));
  EXPECT_THAT(assignments, Contains("env.wind.training_turbulence_max_fps=0"));
}

TEST(Conditions, AirspeedsAreThoseOfTrainingToo) {
  for (const char* condition : {"high_speed=1.0..1.5", "low_speed=hard"}) {
    EXPECT_THAT(ConditionAssignments({condition}),
                Contains("env.initial.training_true_airspeed_min_fps=0"));
  }
}

TEST(Conditions, LevelsOfLowSpeedGoOnWhereThoseOfHighSpeedEnd) {
  const auto speeds = [](const char* condition) {
    return Under({condition}).initial.true_airspeed_fps;
  };
  EXPECT_EQ(speeds("low_speed=mild").max, speeds("high_speed=mild").min);
  EXPECT_EQ(speeds("low_speed=middle").max, speeds("low_speed=mild").min);
  EXPECT_EQ(speeds("low_speed=hard").max, speeds("low_speed=middle").min);
  EXPECT_DOUBLE_EQ(speeds("low_speed=hard").min, 518.5);
  EXPECT_THAT(Complaint({"low_speed=mild", "high_speed=mild"}),
              HasSubstr("high_speed and low_speed both say how fast flights begin"));
  EXPECT_THAT(Complaint({"low_speed=mild,held"}), HasSubstr("cannot read"));
  EXPECT_THAT(Complaint({"low_speed=0.8..1.0,held"}), HasSubstr("cannot read \"0.8..1.0,held\""));
}

TEST(Conditions, ASectorOfWindsGoesClockwiseAcrossNorth) {
  const Range sector = Under({"windy=60fps,from=350..10deg"}).wind.from_deg;
  EXPECT_EQ(sector.min, -10);
  EXPECT_EQ(sector.max, 10);
  const Range other = Under({"windy=60fps,from=10..350deg"}).wind.from_deg;
  EXPECT_EQ(other.min, 10);
  EXPECT_EQ(other.max, 350);
  const Range nearly_all = Under({"windy=60fps,from=-10..-20deg"}).wind.from_deg;
  EXPECT_EQ(nearly_all.min, -10);
  EXPECT_EQ(nearly_all.max, 340);
  EXPECT_THAT(Complaint({"windy=60fps,from=400..20deg"}), HasSubstr("cannot read \"400..20deg\""));
}

TEST(Conditions, ANamedWindMayHaveADirection) {
  const WindConfig wind = Under({"windy=hard,from=270deg"}).wind;
  EXPECT_EQ(wind.speed_fps.max, 200);
  EXPECT_EQ(wind.turbulence_fps.max, 21);
  EXPECT_EQ(wind.from_deg.min, 270);
  EXPECT_EQ(wind.from_deg.max, 270);
  EXPECT_THAT(Complaint({"windy=hard,light"}), HasSubstr("cannot read \"light\""));
  EXPECT_THAT(Complaint({"plant=hard,mass:1.1"}), HasSubstr("cannot read \"hard\""));
}

TEST(Conditions, WhatDiffersFromTheUsualIsSaid) {
  EXPECT_THAT(DescribeConditions(Under({"windy=60fps,severe,from=260..280deg"})),
              HasSubstr("; wind of 60 ft/s from 260 to 280 deg; turbulence of 21 ft/s; noise"));
  EnvConfig env = Under({"windy=severe"});
  EXPECT_THAT(DescribeConditions(env), Not(HasSubstr("from 0 to 360")));
  env.wind.rotational_gusts = true;
  env.flight_control = FlightControlMode::kDirect;
  env.cg = 0.25;
  env.gravity.at_sea_level_ft_s2 = 20;
  EXPECT_THAT(DescribeConditions(env),
              HasSubstr("; turbulence of 21 ft/s, rotational gusts; direct flight control; cg at "
                        "0.25 of the chord; gravity of 20 ft/s^2; noise"));
  EnvConfig carried = Under({"windy=60fps,light,from=270deg"});
  EXPECT_THAT(DescribeConditions(carried), Not(HasSubstr("trimmed in it")));
  carried.wind.step_at_reset = false;
  carried.wind.turbulence_by_altitude = carried.wind.rotational_gusts = true;
  carried.gravity.falls_with_altitude = true;
  carried.engine_angular_momentum = 160;
  EXPECT_THAT(DescribeConditions(carried),
              HasSubstr("; wind of 60 ft/s from 270 deg, trimmed in it; turbulence of 3.7 ft/s at "
                        "20000 ft, elsewhere by MIL-F-8785C, rotational gusts; gravity falls with "
                        "altitude; engine momentum of 160 slug ft^2/s; noise"));
  const std::string other = SKEIN_SOURCE "/examples/aircraft/stevens_lewis_f16.json";
  const EnvConfig own =
      ResolveConfig({"heading", "default", "", {"env.aircraft=\"" + other + "\""}}).train.env;
  EXPECT_THAT(DescribeConditions(own), Not(HasSubstr("cg at"))) << "its own";
}

TEST(Conditions, WhereTrainingAloneBeginsIsSaid) {
  EnvConfig env;
  env.initial.training_altitude_min_ft = 5000;
  env.initial.training_true_airspeed_min_fps = 500;
  EXPECT_THAT(DescribeConditions(env),
              HasSubstr("; in training: starts from 5000 ft; starts from 500 ft/s"));
  EXPECT_EQ(DescribeConditions(EvaluationConfig(env)), DescribeConditions({}));
}

TEST(Conditions, WhatTrainingAloneFliesThroughIsSaid) {
  EXPECT_THAT(
      DescribeConditions(Under({}, "tracking")),
      EndsWith("; still air; noise 0.01; in training: noise up to 0.05; wind up to 120 ft/s; "
               "turbulence up to 10 ft/s; starts from 5000 ft; missions of 3 min"));
  EXPECT_THAT(DescribeConditions(Under({"windy=30fps"}, "tracking")),
              AllOf(HasSubstr("; wind of 30 ft/s; "), Not(HasSubstr("wind up to"))));
  EnvConfig climbing;
  climbing.initial.training_climb_max_deg = 30;
  EXPECT_THAT(DescribeConditions(climbing),
              EndsWith("; still air; noise 0.01; in training: climbs of up to 30 deg"));
  climbing.mission.training_length_s = 60;
  EXPECT_EQ(DescribeConditions(EvaluationConfig(climbing)), DescribeConditions({}));
}

TEST(Conditions, AMachNumberIsASpeedInUnitsOfThatOfSoundAt20000Feet) {
  const EnvConfig env = Under({"high_speed=1.0..1.5"});
  EXPECT_DOUBLE_EQ(env.initial.true_airspeed_fps.min, 1037);
  EXPECT_DOUBLE_EQ(env.initial.true_airspeed_fps.max, 1555.5);
}

TEST(Conditions, WindTakesASpeedAndASeverityOrNumbers) {
  const WindConfig both = Under({"windy=60fps,moderate"}).wind;
  EXPECT_EQ(both.speed_fps.min, 60);
  EXPECT_EQ(both.speed_fps.max, 60);
  EXPECT_EQ(both.turbulence_fps.min, 7.3);
  EXPECT_EQ(both.turbulence_fps.max, 7.3);
  EXPECT_EQ(both.from_deg.min, 0);
  EXPECT_EQ(both.from_deg.max, 360);

  const WindConfig ranges = Under({"windy=light..severe,0..120fps"}).wind;
  EXPECT_EQ(ranges.speed_fps.min, 0);
  EXPECT_EQ(ranges.speed_fps.max, 120);
  EXPECT_EQ(ranges.turbulence_fps.min, 3.7);
  EXPECT_EQ(ranges.turbulence_fps.max, 21);

  const WindConfig numbers = Under({"windy=30kt,sigma=2..5fps,from=260..280deg"}).wind;
  constexpr Tolerance kDigits{1e-3, "three decimals"};
  EXPECT_NEAR(numbers.speed_fps.max, 50.634, kDigits);
  EXPECT_EQ(numbers.turbulence_fps.max, 5);
  EXPECT_EQ(numbers.from_deg.min, 260);
  EXPECT_NEAR(Under({"windy=10m/s"}).wind.speed_fps.max, 32.808, kDigits);

  EXPECT_EQ(Under({"windy=moderate"}).wind.speed_fps.max, 0);
  EXPECT_THAT(Complaint({"windy=60kt..120"}), HasSubstr("cannot read \"60kt..120\""));
  EXPECT_THAT(Complaint({"windy=from=90deg"}), HasSubstr("cannot read"));
  EXPECT_EQ(Under({"windy=60fps"}).wind.turbulence_fps.max, 0);
}

TEST(Conditions, ARegimeCanBeHeldByItsTargets) {
  const EnvConfig held = Under({"high_speed=middle,held", "high_altitude=30..35kft,held"});
  EXPECT_DOUBLE_EQ(held.target_mach_min, 1.2);
  EXPECT_EQ(held.target_altitude_min_ft, 30000);
  EXPECT_EQ(Under({"high_speed=middle"}).target_mach_min, 0);
  EXPECT_THAT(DescribeConditions(held), HasSubstr("targets from Mach 1.2 on"));
  EXPECT_THAT(Complaint({"noisy=0.1,held"}), HasSubstr("cannot read"));
}

TEST(Conditions, PlantTakesQuantitiesAndLeavesTheOthersNominal) {
  const PlantConfig plant =
      Under({"plant=mass:0.9..1.1,cg_shift:-0.05..0.05,action_delay:1..2,sensor_bias:0.02"}).plant;
  EXPECT_EQ(plant.mass.min, 0.9);
  EXPECT_EQ(plant.mass.max, 1.1);
  EXPECT_EQ(plant.cg_shift.min, -0.05);
  EXPECT_EQ(plant.action_delay_steps.min, 1);
  EXPECT_EQ(plant.action_delay_steps.max, 2);
  EXPECT_EQ(plant.sensor_bias, 0.02);
  EXPECT_EQ(plant.thrust.min, 1);
  EXPECT_EQ(Under({"plant=thrust:0.8"}).plant.thrust.max, 0.8);
}

TEST(Conditions, PlantLevelsAreSharesOfTheMiddleOne) {
  const PlantConfig mild = Under({"plant=mild"}).plant, middle = Under({"plant=middle"}).plant;
  const PlantConfig hard = Under({"plant=hard"}).plant;
  EXPECT_DOUBLE_EQ(mild.mass.min, 0.95);
  EXPECT_DOUBLE_EQ(middle.mass.min, 0.9);
  EXPECT_DOUBLE_EQ(hard.mass.min, 0.85);
  EXPECT_DOUBLE_EQ(hard.sensor_bias, 0.03);
  EXPECT_EQ(mild.action_delay_steps.max, 1);
  EXPECT_EQ(middle.action_delay_steps.max, 2);
  EXPECT_EQ(hard.action_delay_steps.max, 3);
  EXPECT_FALSE(Under({"plant=0"}).plant.enabled());
  EXPECT_THROW(Under({"plant=weak_surface:2"}), Error);
}

TEST(Conditions, PlantSaysWhatItCannotRead) {
  EXPECT_THAT(Complaint({"plant=mas:0.9"}), HasSubstr("mass"));
  EXPECT_THAT(Complaint({"plant=mass"}), HasSubstr("plant takes"));
  EXPECT_THAT(Complaint({"plant=mass:0.9,mass:1.1"}), HasSubstr("cannot read"));
  EXPECT_THAT(Complaint({"plant=sensor_bias:0.01..0.02"}), HasSubstr("cannot read"));
  EXPECT_THAT(Complaint({"plant=thrust:0.9,mass:1.1..0.9"}),
              HasSubstr("mass: the range 1.1..0.9 is reversed; write 0.9..1.1"));
  EXPECT_THAT(Complaint({"plant=mass:0.9..1.1kg"}), HasSubstr("cannot read"));
  EXPECT_THAT(Complaint({"plant=sensor_freeze:5..10"}), HasSubstr("sensor_freeze_chance"));
  EXPECT_THAT(Complaint({"plant=sensor_freeze:5..10,sensor_freeze_chance:0"}),
              HasSubstr("sensor_freeze_chance"));
}

TEST(Conditions, AWindNeedsAUnit) {
  EXPECT_EQ(Complaint({"windy=60"}), "--condition windy=60: 60 of what? Write 60fps, 60kt, 60m/s");
  EXPECT_THAT(Complaint({"windy=0..120"}), HasSubstr("of what?"));
  EXPECT_THAT(Complaint({"windy=sigma=5"}), HasSubstr("5 of what?"));
}

TEST(Conditions, WindReplacesAllOfAnotherWind) {
  ProgramConfig config =
      ResolveConfig({"heading", "default", "", {}, {"windy=200fps,severe,from=90deg"}});
  ApplyConditionsAndAssignments({"windy=light"}, {}, &config);
  EXPECT_EQ(config.train.env.wind.speed_fps.max, 0);
  EXPECT_EQ(config.train.env.wind.from_deg.max, 360);
  EXPECT_EQ(config.train.env.wind.turbulence_fps.max, 3.7);
}

TEST(Conditions, AreDescribedInWords) {
  EXPECT_EQ(DescribeConditions(Under({"windy=60fps", "noisy=0.01..0.05", "high_altitude=30kft"})),
            "f16 from 30000 ft and 1000 to 1200 ft/s; wind of 60 ft/s; noise 0.01 to 0.05; "
            "in training: banks of up to 90 deg; pulls of up to 7 g");
  EXPECT_THAT(DescribeConditions(Under({})),
              EndsWith("; noise 0.01; in training: noise up to 0.04; banks of up to 90 deg; "
                       "pulls of up to 7 g"));
  EXPECT_EQ(DescribeConditions(EvaluationConfig(Under({}))),
            "f16 from 19000 to 20000 ft and 1000 to 1200 ft/s; still air; noise 0.01");
  EXPECT_EQ(DescribeConditions(EvaluationConfig(Under({"noisy=0"}))),
            "f16 from 19000 to 20000 ft and 1000 to 1200 ft/s; still air; no noise");
}

TEST(Conditions, PlantsAreToldApart) {
  const auto described = [](const std::string& level) {
    return DescribeConditions(Under({"plant=" + level}));
  };
  EXPECT_THAT(described("mild"), HasSubstr("; plant at 0.5 of the middle level;"));
  EXPECT_THAT(described("1.5"), HasSubstr("; plant at 1.5 of the middle level;"));
  EXPECT_THAT(described("mass:1.05,cg_shift:-0.05..0.05"),
              HasSubstr("; plant: cg_shift -0.05 to 0.05, mass 1.05;"));
  EXPECT_THAT(described("mass:1.05,thrust:0.9,density:1.02,inertia:0.9"),
              HasSubstr("; drawn plants (4 quantities);"));
  EXPECT_EQ(described("0").find("plant"), std::string::npos);
}

TEST(Conditions, EvaluationsAreDescribedWithWhatCounts) {
  EnvConfig env = Under({});
  EXPECT_EQ(DescribeEvaluation(env),
            "f16 from 19000 to 20000 ft and 1000 to 1200 ft/s; still air; noise 0.01; drag rise "
            "and thrust growth; a target counts after 1 s and is held for 8 s");
  env.drag_rises = false;
  env.heading.dwell_s = 0;
  EXPECT_THAT(DescribeEvaluation(env), EndsWith("0.01; thrust growth; targets held for 8 s"));
  env.hold_s = 0;
  env.mission.length_s = 600;
  EXPECT_THAT(DescribeEvaluation(env), EndsWith("0.01; thrust growth; missions of 10 min"));
  EXPECT_THAT(DescribeEvaluation(Under({"high_altitude=30kft"})), HasSubstr("; 1976 atmosphere;"));
}

TEST(Conditions, EveryLevelOfEachOnEveryTaskCanBeFlown) {
  for (const std::string& task : TaskNames()) {
    for (const char* level : {"mild", "middle", "hard"}) {
      std::vector<std::string> together;
      for (const char* name : {"high_speed", "high_altitude", "windy", "noisy", "plant"}) {
        const std::string condition = std::string(name) + "=" + level;
        EXPECT_NO_THROW(VecEnv(Under({condition}, task), 32, 1)) << task << " " << condition;
        together.push_back(condition);
      }
      EXPECT_NO_THROW(VecEnv(Under(together, task), 32, 1)) << task << " " << level;
      const std::string slow = std::string("low_speed=") + level;
      EXPECT_NO_THROW(VecEnv(Under({slow}, task), 32, 1)) << task << " " << slow;
    }
  }
}

TEST(Conditions, SingleKeysAreStronger) {
  const ProgramConfig config =
      ResolveConfig({"heading",
                     "default",
                     "",
                     {"env.wind.step_at_reset=false", "env.observation_noise=0"},
                     {"windy=60fps", "noisy=0.03"}});
  EXPECT_FALSE(config.train.env.wind.step_at_reset);
  EXPECT_EQ(config.train.env.observation_noise, 0);
}

TEST(Conditions, WhatCannotBeReadIsNamedWithWhatCould) {
  EXPECT_THAT(Complaint({"wndy=60fps"}), HasSubstr("unknown condition wndy; did you mean windy?"));
  EXPECT_THAT(Complaint({"windy"}), HasSubstr("--condition windy: expected NAME=LEVEL"));
  EXPECT_THAT(Complaint({"noisy=0.1", "noisy=0.2"}), HasSubstr("noisy is given twice"));
  EXPECT_THAT(Complaint({"noisy=loud"}), HasSubstr("cannot read \"loud\"; noisy takes"));
  EXPECT_THAT(Complaint({"windy=60mph"}),
              HasSubstr("60mph has the unknown unit mph; known: fps, kt, m/s"));
  EXPECT_THAT(Complaint({"high_altitude=30..35km"}), HasSubstr("unknown unit km; known: kft, ft"));
  EXPECT_THAT(Complaint({"windy=60fps,moderat"}), HasSubstr("cannot read \"moderat\""));
  EXPECT_THAT(Complaint({"windy=60fps,90fps"}), HasSubstr("cannot read \"90fps\""));
  EXPECT_THAT(Complaint({"windy=severe..light"}),
              HasSubstr("the range severe..light is reversed; write light..severe"));
  EXPECT_THAT(Complaint({"high_speed=1.4..1.2"}),
              HasSubstr("the range 1.4..1.2 is reversed; write 1.2..1.4"));
  EXPECT_THAT(Complaint({"windy=120..60fps"}), HasSubstr("is reversed; write 60fps..120fps"));
  EXPECT_THAT(Complaint({"high_altitude="}), HasSubstr("cannot read \"\""));
  EXPECT_THAT(Complaint({"high_altitude=32000"}), HasSubstr("are thousands of feet"));
  EXPECT_THAT(Complaint({"high_speed=700..900"}),
              HasSubstr("that is up to Mach 900, and 2.89 is the most; numbers are Mach numbers"));
  EXPECT_EQ(Under({"high_speed=2.89"}).initial.true_airspeed_fps.max, 2.89 * 1037);
  EXPECT_THAT(Complaint({"windy=,light"}), HasSubstr("cannot read \"\""));
}

}  // namespace
}  // namespace skein
