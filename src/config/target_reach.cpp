// SPDX-License-Identifier: Apache-2.0
#include "src/config/target_reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "envs/air/atmosphere.h"
#include "envs/aircraft/registry.h"
#include "envs/tasks/terms/term_task_config.h"
#include "envs/tasks/terms/term_values.h"

namespace skein {
namespace {

/// Where both atmospheres are coldest: sound is slowest there.
constexpr double kColdest_ft = 60000;

/// Where a target can be, of flights that begin in `start`.
Range DrawnOf(const TermTarget& target, const Range& start) {
  if (target.draw_from == TermTarget::Draw::kBetween) return target.draw;
  return {start.min + target.draw.min, start.max + target.draw.max};
}

/// What is given of that column, alone.
std::optional<Range> GivenOf(const GivenTargets& given, const std::string& column) {
  const auto found = given.find(column);
  if (found == given.end()) return std::nullopt;
  return Range{found->second, found->second};
}

/// Of a target of which the nearest value to what can be flown is `nearest`, and others are `more`
/// ("or more") or none.
std::string Beyond(const TermTarget& target, double nearest, const std::string& more,
                   const std::string& limit) {
  const std::string& unit = target.quantity.name;
  return fmt::format("target {} cannot be reached: it is {:.5g}{}{}, but flights end {}",
                     target.name, nearest * target.quantity.per_value, more,
                     unit == target.name ? "" : " (" + unit + ")", limit);
}
std::string AboveAll(const TermTarget& target, const Range& drawn, const std::string& limit) {
  return Beyond(target, drawn.min, drawn.max > drawn.min ? " or more" : "", limit);
}
std::string BelowAll(const TermTarget& target, const Range& drawn, const std::string& limit) {
  return Beyond(target, drawn.max, drawn.max > drawn.min ? " or less" : "", limit);
}

/// Empty if some of `drawn` can be flown. `least_sound` and `most_sound` make Mach numbers of it.
std::string BeyondMach(const TermTarget& target, const Range& drawn, double least_sound,
                       double most_sound, const TerminationConfig& limits) {
  if (drawn.min > limits.max_mach * most_sound) {
    return AboveAll(target, drawn,
                    fmt::format("above Mach {:g} (env.termination.max_mach)", limits.max_mach));
  }
  if (drawn.max < limits.min_mach * least_sound) {
    return BelowAll(target, drawn,
                    fmt::format("below Mach {:g} (env.termination.min_mach)", limits.min_mach));
  }
  return "";
}

std::string BeyondAltitude(const TermTarget& target, const Range& drawn,
                           const TerminationConfig& limits) {
  if (drawn.max >= limits.min_altitude_ft) return "";
  return BelowAll(
      target, drawn,
      fmt::format("below {:.5g} ft (env.termination.min_altitude_ft)", limits.min_altitude_ft));
}

/// Where an end of a task file begins, of values such as targets have.
struct OwnEnd {
  bool above = false, below = false;  ///< beyond its limit; both of abs(x)
  double limit = 0;
};

/// The ends of the task file that are of that value.
std::vector<OwnEnd> OwnEndsOf(const EnvConfig& env, TermValue value) {
  std::vector<OwnEnd> ends;
  if (env.term_task == nullptr) return ends;
  for (const auto& [condition, termination] : env.term_task->ends) {
    const TermUnit& unit = condition.number.unit;
    if (condition.number.value != value || unit.reference != ReferenceUnit::kNone) continue;
    using Kind = TermCondition::Kind;
    ends.push_back({condition.kind == Kind::kAbove || condition.kind == Kind::kBeyond,
                    condition.kind == Kind::kBelow || condition.kind == Kind::kBeyond,
                    condition.limit * unit.number / condition.number.per_value});
  }
  return ends;
}

/// Empty if some of `drawn` can be flown.
std::string BeyondOwnEnds(const TermTarget& target, const Range& drawn, const EnvConfig& env) {
  const auto limit = [&target](const char* side, double value) {
    return fmt::format("{} {:.5g} ([[termination]])", side, value * target.quantity.per_value);
  };
  for (const OwnEnd& end : OwnEndsOf(env, target.quantity.value)) {
    if (end.above && drawn.min > end.limit) {
      return AboveAll(target, drawn, limit("above", end.limit));
    }
    const double least = end.above ? -end.limit : end.limit;
    if (end.below && drawn.max < least) return BelowAll(target, drawn, limit("below", least));
  }
  return "";
}

/// Whether the target is what is drawn between two values, neither raised nor wrapped.
bool IsFlownToAsDrawn(const TermTarget& target, const EnvConfig& env) {
  if (target.draw_from != TermTarget::Draw::kBetween) return false;
  const double furthest = std::max(std::abs(target.draw.min), std::abs(target.draw.max));
  switch (target.quantity.value) {
    case TermValue::kAltitude:
      return !env.mission.enabled() && env.target_altitude_min_ft <= 0;
    case TermValue::kTrueAirspeed:
      return env.target_mach_min <= 0;
    case TermValue::kPitch:
      return furthest <= M_PI / 2;
    default:
      return !IsWrapped(target.quantity.value) || furthest <= M_PI;
  }
}

/// A line about an angle of more than a turn; empty if all that is drawn or given lies within one.
std::string BeyondATurn(const TermTarget& target, const std::optional<Range>& alone) {
  const double shown = target.quantity.per_value;
  const double furthest =
      alone ? std::abs(alone->max)
            : shown * std::max(std::abs(target.draw.min), std::abs(target.draw.max));
  if (furthest <= 2 * M_PI * shown) return "";
  return fmt::format("target {} is {}{:.5g}, more than a turn: it is flown to modulo {:g}",
                     target.name, alone ? "" : "up to ", alone ? alone->max : furthest,
                     2 * M_PI * shown);
}

std::string BeyondLimits(const TermTarget& target, const EnvConfig& env,
                         const GivenTargets& given) {
  const TerminationConfig& limits = env.termination;
  const std::optional<Range> alone = GivenOf(given, target.quantity.name);
  if (!alone && IsFlownToAsDrawn(target, env)) {
    std::string line = BeyondOwnEnds(target, target.draw, env);
    if (!line.empty()) return line;
  }
  switch (target.quantity.value) {
    case TermValue::kAltitude: {
      if (alone) return BeyondAltitude(target, *alone, limits);
      if (env.mission.enabled()) return "";  // raises what is drawn too low
      Range drawn = DrawnOf(target, env.initial.altitude_ft);
      if (env.target_altitude_min_ft > 0) {
        drawn.max = std::max(drawn.max, env.target_altitude_min_ft);
      }
      return BeyondAltitude(target, drawn, limits);
    }
    case TermValue::kTrueAirspeed: {
      const auto sound = [&env](double altitude_ft) {
        return AirAt(env.atmosphere, altitude_ft).sound_speed_ft_s;
      };
      const double least_sound = sound(kColdest_ft);
      Range drawn = DrawnOf(target, env.initial.true_airspeed_fps);
      drawn.max = std::max(drawn.max, env.target_mach_min * least_sound);
      return BeyondMach(target, alone.value_or(drawn), least_sound, sound(limits.min_altitude_ft),
                        limits);
    }
    case TermValue::kMach:
      return BeyondMach(target, alone.value_or(target.draw), 1, 1, limits);
    default:
      return IsWrapped(target.quantity.value) ? BeyondATurn(target, alone) : "";
  }
}

/// What is given of a built-in task, as targets of a task file.
std::vector<TermTarget> TargetsOfBuiltIn(const GivenTargets& given) {
  std::vector<TermTarget> targets;
  for (const TermName& known : TermNames()) {
    if (given.count(known.name) == 0) continue;
    TermTarget target;
    target.name = target.quantity.name = known.name;
    target.quantity.value = known.value;
    target.quantity.per_value = known.per_value;
    targets.push_back(std::move(target));
  }
  return targets;
}

/// The altitude of the highest point that is drawn around the horizon.
double HighestPoint(const EnvConfig& env, const Range& distance_ft, double elevation_deg) {
  return env.initial.altitude_ft.max + distance_ft.max * std::sin(elevation_deg / kDegPerRad);
}

/// Targets that have an altitude, as messages call them, each with the highest that may be asked.
std::vector<std::pair<std::string, double>> HighestTargets(const EnvConfig& env,
                                                           const GivenTargets& given) {
  std::vector<std::pair<std::string, double>> highest;
  if (env.term_task != nullptr) {
    for (const TermTarget& target : env.term_task->targets) {
      if (target.draw_from == TermTarget::Draw::kPoint) {
        highest.emplace_back("target " + target.name,
                             HighestPoint(env, target.distance_ft, target.elevation_deg));
      } else if (target.quantity.value == TermValue::kAltitude) {
        highest.emplace_back("target " + target.name, DrawnOf(target, env.initial.altitude_ft).max);
      }
    }
  } else if (env.task == "heading") {
    highest.emplace_back("the target altitude",
                         env.initial.altitude_ft.max + env.heading.altitude_change_ft);
  } else if (env.task == "tracking") {
    highest.emplace_back("the target",
                         HighestPoint(env, env.tracking.distance_ft, env.tracking.elevation_deg));
  }
  for (auto& [name, altitude_ft] : highest) {
    altitude_ft = std::max(altitude_ft, env.target_altitude_min_ft);
  }
  const std::optional<Range> alone = GivenOf(given, "altitude_ft");
  if (alone && !highest.empty()) highest.front().second = alone->max;
  return highest;
}

}  // namespace

std::vector<std::string> AltitudesBeyondTables(const EnvConfig& env, const GivenTargets& given) {
  // Of tables in metres: 50,000 ft come back as a little less.
  constexpr double kRounding_ft = 1e-3;
  const double end_ft = LoadAircraft(env.aircraft).engine.altitude_ft.back();
  std::vector<std::string> lines;
  const auto append = [&](const std::string& what, double altitude_ft) {
    if (altitude_ft <= end_ft + kRounding_ft) return;
    lines.push_back(
        fmt::format("{} at up to {:.0f} ft: the engine's tables end at {:.0f} ft, and thrust above "
                    "is held as there",
                    what, altitude_ft, end_ft));
  };
  append("flights begin", env.initial.altitude_ft.max);
  for (const auto& [name, altitude_ft] : HighestTargets(env, given)) {
    append(name + " is", altitude_ft);
  }
  return lines;
}

std::vector<std::string> WindsBeyondAirspeed(const EnvConfig& env) {
  const double wind = env.wind.speed_fps.max, slowest = env.initial.true_airspeed_fps.min;
  if (!env.wind.step_at_reset || wind < slowest) return {};
  return {fmt::format(
      "winds of up to {:.6g} ft/s met as a step at {:.6g} ft/s: flights may end as they begin",
      wind, slowest)};
}

std::vector<std::string> StartsBeyondOwnEnds(const EnvConfig& env) {
  std::vector<std::string> lines;
  const auto append = [&](const char* name, TermValue value, const Range& start) {
    for (const OwnEnd& end : OwnEndsOf(env, value)) {
      const bool is_above = end.above && start.min > end.limit;
      if (!is_above && !(end.below && !end.above && start.max < end.limit)) continue;
      lines.push_back(fmt::format(
          "flights end as they begin: with {} from {:.5g} to {:.5g}, and a [[termination]] is {} "
          "{:.5g}",
          name, start.min, start.max, is_above ? "above" : "below", end.limit));
    }
  };
  append("altitude_ft", TermValue::kAltitude, env.initial.altitude_ft);
  append("true_airspeed_fps", TermValue::kTrueAirspeed, env.initial.true_airspeed_fps);
  return lines;
}

std::vector<std::string> TargetsBeyondLimits(const EnvConfig& env, const GivenTargets& given) {
  std::vector<std::string> lines;
  const std::vector<TermTarget> targets =
      env.term_task == nullptr ? TargetsOfBuiltIn(given) : env.term_task->targets;
  for (const TermTarget& target : targets) {
    std::string line = BeyondLimits(target, env, given);
    if (!line.empty()) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace skein
