// SPDX-License-Identifier: Apache-2.0
#include "src/config/conditions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <set>
#include <utility>

#include "base/ends_with.h"
#include "base/error.h"
#include "base/nearest_name.h"
#include "envs/aircraft/registry.h"
#include "envs/env_config.h"
#include "envs/initial_config.h"
#include "envs/task_registry.h"
#include "envs/wind/dryden.h"
#include "src/config/condition_level.h"
#include "src/config/plant_condition.h"

namespace skein {
namespace {

/// The speed of sound at 20,000 ft: what a Mach number of high_speed and low_speed stands for.
constexpr double kSpeedOfMachOne = 1037;
constexpr double kFpsPerKnot = 1852 / 0.3048 / 3600;
constexpr double kFpsPerMetrePerSecond = 1 / 0.3048;

const Units kMachUnits = {{"", kSpeedOfMachOne}};
const Units kAltitudeUnits = {{"kft", 1000}, {"ft", 1}, {"", 1000}};
// None is the usual one of winds: a number alone is refused.
const Units kSpeedUnits = {{"fps", 1}, {"kt", kFpsPerKnot}, {"m/s", kFpsPerMetrePerSecond}};
const Units kAngleUnits = {{"deg", 1}, {"", 1}};
const Units kPlain = {{"", 1}};

Range ParseSeverity(const std::string& text, const LevelRequest& request) {
  const auto deviation = [&](const std::string& name) {
    for (const TurbulenceSeverity& severity : kTurbulenceSeverities) {
      if (name == severity.name) return severity.standard_deviation_fps;
    }
    request.Refuse(name);
  };
  const auto [low, high] = SplitRange(text);
  const Range range{deviation(low), deviation(high)};
  if (range.min > range.max) request.RefuseReversed("the range " + text, low, high);
  return range;
}

/// The two assignments of a range.
void Append(const char* quantity, const char* unit, const Range& range,
            std::vector<std::string>* assignments) {
  assignments->push_back(fmt::format("env.{}_min{}={}", quantity, unit, range.min));
  assignments->push_back(fmt::format("env.{}_max{}={}", quantity, unit, range.max));
}

using Assignments = std::vector<std::string>;

/// Of high_speed and low_speed.
Assignments Airspeed(const LevelRequest& request, const std::string& level) {
  const Range speed = ParseRange(level, kMachUnits, request);
  if (speed.max > kFastestStartFps) {
    throw Error(
        fmt::format("--condition {}={}: that is up to Mach {:g}, and {:.3g} is the most; numbers "
                    "are Mach numbers, of {:g} ft/s",
                    request.name, request.level, speed.max / kSpeedOfMachOne,
                    kFastestStartFps / kSpeedOfMachOne, kSpeedOfMachOne));
  }
  Assignments assignments;
  Append("initial.true_airspeed", "_fps", speed, &assignments);
  assignments.push_back(
      fmt::format("env.target_mach_min={}", request.is_held ? speed.min / kSpeedOfMachOne : 0));
  assignments.emplace_back("env.initial.training_true_airspeed_min_fps=0");
  return assignments;
}

Assignments HighAltitude(const LevelRequest& request, const std::string& level) {
  const Range altitude = ParseRange(level, kAltitudeUnits, request);
  if (altitude.max > kHighestStartFt) {
    throw Error(
        fmt::format("--condition {}={}: that is up to {:.0f} ft, and {:.0f} are the most; "
                    "numbers without a unit are thousands of feet (35kft, 35000ft)",
                    request.name, request.level, altitude.max, kHighestStartFt));
  }
  Assignments assignments;
  Append("initial.altitude", "_ft", altitude, &assignments);
  assignments.push_back(
      fmt::format("env.target_altitude_min_ft={}", request.is_held ? altitude.min : 0));
  assignments.emplace_back("env.initial.training_altitude_min_ft=0");
  // What flies level low down may be below stall speed up there.
  assignments.emplace_back("env.initial.training_true_airspeed_min_fps=0");
  // The published models' air is up to 9 % too dense above their tropopause.
  assignments.emplace_back("env.atmosphere=standard_1976");
  return assignments;
}

Assignments Noisy(const LevelRequest& request, const std::string& level) {
  const Range range = ParseRange(level, kPlain, request);
  return {fmt::format("env.observation_noise={}", range.min),
          fmt::format("env.observation_noise_max={}", range.max > range.min ? range.max : 0),
          "env.training_noise_max=0"};
}

/// A sector of bearings, clockwise: one whose end is the smaller goes across north.
Range ParseSector(const std::string& text, const LevelRequest& request) {
  const auto [begin, end] = SplitRange(text);
  constexpr double kTurn = 360;  // bearings lie within one to either side
  const Range sector{ParseNumber(begin, kAngleUnits, request),
                     ParseNumber(end, kAngleUnits, request)};
  if (std::abs(sector.min) > kTurn || std::abs(sector.max) > kTurn) request.Refuse(text);
  if (sector.min <= sector.max) return sector;
  return sector.min >= 0 ? Range{sector.min - kTurn, sector.max}
                         : Range{sector.min, sector.max + kTurn};
}

Assignments Windy(const LevelRequest& request, const std::string& level) {
  Assignments assignments;
  std::set<std::string> given;
  const auto append = [&](const std::string& part, const char* quantity, const char* unit,
                          const Range& range) {
    if (!given.insert(quantity).second) request.Refuse(part);
    Append(quantity, unit, range, &assignments);
  };
  for (const std::string& part : SplitParts(level)) {
    const auto value_of = [&part](const char* label) -> std::optional<std::string> {
      const std::size_t length = std::strlen(label);
      if (part.compare(0, length, label) != 0) return std::nullopt;
      return part.substr(length);
    };
    if (const auto from = value_of("from=")) {
      append(part, "wind.from", "_deg", ParseSector(*from, request));
    } else if (const auto sigma = value_of("sigma=")) {
      append(part, "wind.turbulence", "_fps", ParseRange(*sigma, kSpeedUnits, request));
    } else if (StartsWithDigit(part)) {
      append(part, "wind.speed", "_fps", ParseRange(part, kSpeedUnits, request));
    } else {
      append(part, "wind.turbulence", "_fps", ParseSeverity(part, request));
    }
  }
  // What is not named is as in no wind, whatever the configuration has.
  if (given == std::set<std::string>{"wind.from"}) request.Refuse(level);
  const WindConfig still;
  if (given.count("wind.speed") == 0) append("", "wind.speed", "_fps", still.speed_fps);
  if (given.count("wind.from") == 0) append("", "wind.from", "_deg", still.from_deg);
  if (given.count("wind.turbulence") == 0) {
    append("", "wind.turbulence", "_fps", still.turbulence_fps);
  }
  assignments.emplace_back("env.wind.training_speed_max_fps=0");
  assignments.emplace_back("env.wind.training_turbulence_max_fps=0");
  return assignments;
}

constexpr const char* kHeld = ",held";

/// Cuts ",held" off a level's end; whether it was there.
bool CutHeld(std::string* level) {
  if (!EndsWith(*level, kHeld)) return false;
  level->resize(level->size() - std::strlen(kHeld));
  return true;
}

struct Condition {
  const char* name;
  const char* form;
  const char* mild;
  const char* middle;
  const char* hard;
  bool can_be_held, takes_parts;
  Assignments (*assign)(const LevelRequest& request, const std::string& level);

  /// `level` with what its name stands for in the place of that; parts may follow it if they may
  /// follow each other.
  std::string LevelText(const std::string& level) const {
    const std::size_t end = takes_parts ? std::min(level.find(','), level.size()) : level.size();
    const std::string word = level.substr(0, end);
    for (const auto& [known, text] :
         {std::pair("mild", mild), {"middle", middle}, {"hard", hard}}) {
      if (word == known) return text + level.substr(end);
    }
    return level;
  }
};

const std::vector<Condition>& Conditions() {
  static const std::vector<Condition> conditions = {
      {"high_speed",
       "an initial Mach number or range (1.2, 1.2..1.4) or mild, middle, hard; "
       "with ,held behind it no target speed is lower",
       "1.0..1.2", "1.2..1.4", "1.4..1.8", true, false, Airspeed},
      {"low_speed", "an initial Mach number or range (0.7, 0.6..0.8) or mild, middle, hard",
       "0.8..1.0", "0.65..0.8", "0.5..0.65", false, false, Airspeed},
      {"high_altitude",
       "an initial altitude or range (32kft, 30..35kft) or mild, middle, hard; "
       "with ,held behind it no target altitude is lower",
       "30..35kft", "35..40kft", "40..45kft", true, false, HighAltitude},
      {"windy",
       "a steady wind and turbulence by severity, each alone or a range (60fps,moderate; "
       "0..120fps,light..severe; sigma=5fps,from=270deg) or mild, middle, hard (hard,from=270deg)",
       "60fps,light", "120fps,moderate", "200fps,severe", false, true, Windy},
      {"noisy", "a standard deviation or range (0.03, 0.01..0.05) or mild, middle, hard", "0.02",
       "0.05", "0.1", false, false, Noisy},
      {"plant", kPlantForm, "0.5", "1", "1.5", false, false, PlantAssignments}};
  return conditions;
}

const Condition& FindCondition(const std::string& name) {
  std::vector<std::string> names;
  for (const Condition& condition : Conditions()) {
    if (name == condition.name) return condition;
    names.emplace_back(condition.name);
  }
  throw Error(fmt::format("--condition: unknown condition {}{}; known: {}", name,
                          DidYouMean(name, names), fmt::join(names, ", ")));
}

/// "; in training: noise up to 0.05; starts from 5000 ft": what evaluations do without; empty if
/// that is nothing.
std::string DescribeTraining(const EnvConfig& env) {
  const EnvConfig evaluated = EvaluationConfig(env);
  const InitialConfig &start = env.initial, &evaluated_start = evaluated.initial;
  std::string all;
  const auto add = [&](bool differs, const char* form, double value) {
    if (!differs) return;
    all += all.empty() ? "; in training: " : "; ";
    all += fmt::format(fmt::runtime(form), value);
  };
  const auto add_most = [&](const char* form, double trained, double flown) {
    add(trained > flown, form, trained);
  };
  const auto add_least = [&](const char* form, const Range& trained, const Range& flown) {
    add(trained.min < flown.min, form, trained.min);
  };
  add_most("noise up to {:.6g}", env.most_noise(),
           std::max(evaluated.observation_noise, evaluated.most_noise()));
  add_most("wind up to {:.6g} ft/s", env.wind.drawn_speed_fps().max,
           evaluated.wind.drawn_speed_fps().max);
  add_most("turbulence up to {:.6g} ft/s", env.wind.drawn_turbulence_fps().max,
           evaluated.wind.drawn_turbulence_fps().max);
  add_least("starts from {:.6g} ft", start.drawn_altitude_ft(),
            evaluated_start.drawn_altitude_ft());
  add_least("starts from {:.6g} ft/s", start.drawn_true_airspeed_fps(),
            evaluated_start.drawn_true_airspeed_fps());
  add_most("banks of up to {:.6g} deg", start.training_bank_max_deg,
           evaluated_start.training_bank_max_deg);
  add_most("climbs of up to {:.6g} deg", start.training_climb_max_deg,
           evaluated_start.training_climb_max_deg);
  add_most("pulls of up to {:.6g} g", env.starting_load_factor_max(),
           evaluated.starting_load_factor_max());
  add(env.mission.is_of_training(), "missions of {:.6g} min", env.mission.flown_length_s() / 60);
  return all;
}

/// "; drag rise; a target counts after 1 s and is held for 8 s".
std::string DescribeRules(const EnvConfig& env) {
  std::string rules;
  if (env.atmosphere == AtmosphereModel::kStandard1976) rules += "; 1976 atmosphere";
  if (env.drag_rises) rules += "; drag rise";
  if (env.thrust_grows) rules += env.drag_rises ? " and thrust growth" : "; thrust growth";
  const MissionConfig& mission = env.mission;
  if (mission.enabled()) {
    return rules + fmt::format("; missions of {:.6g} min", mission.flown_length_s() / 60);
  }
  const double dwell = MakeTask(env)->dwell_s();
  if (dwell > 0) rules += fmt::format("; a target counts after {:.6g} s", dwell);
  if (env.hold_s > 0) {
    rules +=
        fmt::format("{} for {:.6g} s", dwell > 0 ? " and is held" : "; targets held", env.hold_s);
  }
  return rules;
}

}  // namespace

std::vector<std::string> ConditionAssignments(const std::vector<std::string>& conditions) {
  Assignments all;
  std::set<std::string> names;
  for (const std::string& text : conditions) {
    const auto equals = text.find('=');
    if (equals == std::string::npos) {
      throw Error(fmt::format("--condition {}: expected NAME=LEVEL, such as noisy=0.03", text));
    }
    const LevelRequest request{text.substr(0, equals), text.substr(equals + 1), ""};
    const Condition& condition = FindCondition(request.name);
    if (!names.insert(request.name).second) {
      throw Error(fmt::format("--condition {}: {} is given twice", text, request.name));
    }
    if (names.count("high_speed") + names.count("low_speed") > 1) {
      throw Error(fmt::format(
          "--condition {}: high_speed and low_speed both say how fast flights begin", text));
    }
    std::string level = request.level;
    const bool is_held = condition.can_be_held && CutHeld(&level);
    const Assignments assignments = condition.assign(
        {request.name, request.level, condition.form, is_held}, condition.LevelText(level));
    all.insert(all.end(), assignments.begin(), assignments.end());
  }
  return all;
}

std::string DescribeConditions(const EnvConfig& env) {
  const auto range = [](const Range& values, const char* unit) {
    return values.min == values.max
               ? fmt::format("{:.6g}{}", values.min, unit)
               : fmt::format("{:.6g} to {:.6g}{}", values.min, values.max, unit);
  };
  const WindConfig& wind = env.wind;
  std::string air = EvaluationConfig(env).wind.enabled() ? "" : "; still air";
  if (wind.speed_fps.max > 0) air += "; wind of " + range(wind.speed_fps, " ft/s");
  const bool is_from_anywhere = wind.from_deg.max - wind.from_deg.min >= 360;
  if (wind.speed_fps.max > 0 && !is_from_anywhere) {
    air += " from " + range(wind.from_deg, " deg");
  }
  if (wind.speed_fps.max > 0 && !wind.step_at_reset) air += ", trimmed in it";
  if (wind.turbulence_fps.max > 0) {
    air += "; turbulence of " + range(wind.turbulence_fps, " ft/s");
    if (wind.turbulence_by_altitude) air += " at 20000 ft, elsewhere by MIL-F-8785C";
    if (wind.rotational_gusts) air += ", rotational gusts";
  }
  if (env.flight_control == FlightControlMode::kDirect) air += "; direct flight control";
  if (env.cg != LoadAircraft(env.aircraft).airframe.cg) {
    air += fmt::format("; cg at {:.6g} of the chord", env.cg);
  }
  if (env.gravity.at_sea_level_ft_s2 != Gravity().at_sea_level_ft_s2) {
    air += fmt::format("; gravity of {:.6g} ft/s^2", env.gravity.at_sea_level_ft_s2);
  }
  if (env.gravity.falls_with_altitude) air += "; gravity falls with altitude";
  if (env.engine_angular_momentum != 0) {
    air += fmt::format("; engine momentum of {:.6g} slug ft^2/s", env.engine_angular_momentum);
  }
  const std::string plant = DescribePlant(env.plant);
  if (!plant.empty()) air += "; " + plant;
  if (env.target_mach_min > 0) {
    air += fmt::format("; targets from Mach {:.6g} on", env.target_mach_min);
  }
  if (env.target_altitude_min_ft > 0) {
    air += fmt::format("; targets from {:.6g} ft on", env.target_altitude_min_ft);
  }
  const double most_noise = std::max(env.observation_noise, env.observation_noise_max);
  return fmt::format(
      "{} from {} and {}{}; {}{}", env.aircraft, range(env.initial.altitude_ft, " ft"),
      range(env.initial.true_airspeed_fps, " ft/s"), air,
      most_noise > 0 ? "noise " + range({env.observation_noise, most_noise}, "") : "no noise",
      DescribeTraining(env));
}

std::string DescribeEvaluation(const EnvConfig& env) {
  const EnvConfig flown = EvaluationConfig(env);
  return DescribeConditions(flown) + DescribeRules(flown);
}

std::vector<ConditionForm> ConditionForms() {
  std::vector<ConditionForm> forms;
  for (const Condition& condition : Conditions()) {
    forms.push_back(
        {condition.name, condition.form, condition.mild, condition.middle, condition.hard});
  }
  return forms;
}

std::string ConditionHelp() {
  std::string names;
  for (const Condition& condition : Conditions()) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", condition.name);
  }
  return fmt::format(
      "fly under a condition: {}; LEVEL is a value, a range A..B from which every "
      "episode draws, or mild, middle, hard; may be repeated (docs/reference/conditions.md)",
      names);
}

}  // namespace skein
