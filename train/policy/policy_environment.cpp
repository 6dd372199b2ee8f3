// SPDX-License-Identifier: Apache-2.0
#include "train/policy/policy_environment.h"

#include <charconv>

#include "base/error.h"
#include "base/name_in.h"
#include "envs/tasks/task.h"

namespace skein {
namespace {

constexpr const char* kLowLevelTask = "control";
constexpr const char* kErrorAxes = "tracking.error_axes";
constexpr const char* kAveragesObservations = "high_level.averages_observations";

/// The shortest text that is read back as the same double.
std::string Text(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace

std::map<std::string, std::string> PolicyEnvironment(const EnvConfig& env) {
  std::map<std::string, std::string> environment;
  environment["aircraft"] = env.aircraft;
  environment["control_interval_s"] = Text(env.control_interval_s);
  environment["flight_control"] = NameIn(kFlightControlNames, env.flight_control);
  if (!IsHierarchical(env.task)) return environment;
  environment["high_level.pitch_change_rad"] = Text(env.high_level.pitch_change_rad);
  environment["high_level.yaw_change_rad"] = Text(env.high_level.yaw_change_rad);
  environment["high_level.speed_change_fps"] = Text(env.high_level.speed_change_fps);
  environment[kAveragesObservations] = env.high_level.averages_observations ? "true" : "false";
  if (env.task == "tracking") {
    environment[kErrorAxes] = Name(env.tracking.error_axes);
  }
  return environment;
}

void AdoptView(const std::map<std::string, std::string>& made_with, EnvConfig* env) {
  if (const auto found = made_with.find(kErrorAxes); found != made_with.end()) {
    for (const auto& [axes, name] : kTrackingAxesNames) {
      if (found->second == name) env->tracking.error_axes = axes;
    }
  }
  if (const auto found = made_with.find(kAveragesObservations); found != made_with.end()) {
    env->high_level.averages_observations = found->second == "true";
  }
}

void CheckMadeWith(const EnvConfig& env, const std::map<std::string, std::string>& made_with,
                   const std::string& who) {
  for (const auto& [key, value] : PolicyEnvironment(env)) {
    const auto found = made_with.find(key);
    if (found == made_with.end() || found->second == value) continue;
    throw Error(who + " was made with env." + key + " = " + found->second +
                ", but is to fly with env." + key + " = " + value);
  }
}

void CheckLowLevelMadeFor(const EnvConfig& env, const Policy& low_level, const std::string& who) {
  EnvConfig below = env;
  below.task = kLowLevelTask;
  low_level.CheckMadeFor(below, who);
}

}  // namespace skein
