// SPDX-License-Identifier: Apache-2.0
#include "train/policy/policy_environment.h"

#include <charconv>

#include "base/error.h"
#include "base/name_in.h"
#include "envs/tasks/task.h"
#include "train/policy/autopilot_policy.h"
#include "train/policy/policy_parameters.h"

namespace skein {
namespace {

constexpr const char* kLowLevelPolicysTask = "control";
constexpr const char* kErrorAxes = "tracking.error_axes";
constexpr const char* kAveragesObservations = "high_level.averages_observations";

/// The shortest text that is read back as the same double.
std::string Text(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

void RequireSame(const std::string& key, const std::string& made_with, const std::string& value,
                 const std::string& who) {
  if (made_with == value) return;
  throw Error(who + " was made with env." + key + " = " + made_with + ", but is to fly with env." +
              key + " = " + value);
}

void CheckAutopilot(const EnvConfig& env, const AutopilotPolicy& autopilot,
                    const std::string& who) {
  RequireSame("control_interval_s", Text(autopilot.control_interval_s()),
              Text(env.control_interval_s), who);
  try {
    AutopilotPolicy(autopilot.variant(), env);
  } catch (const Error& error) {
    throw Error(who + ": " + error.what());
  }
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

void CheckMadeFor(const EnvConfig& env, const Policy& pilot, const std::string& who) {
  if (const auto* const autopilot = dynamic_cast<const AutopilotPolicy*>(&pilot)) {
    CheckAutopilot(env, *autopilot, who);
    return;
  }
  const auto* const policy = dynamic_cast<const RecurrentPolicy*>(&pilot);
  if (policy == nullptr) return;
  if (!policy->task().empty()) RequireSame("task", policy->task(), env.task, who);
  CheckMadeWith(env, policy->parameters()->environment, who);
  if (policy->low_level() == nullptr) return;
  CheckLowLevelMadeFor(env, *policy->low_level(), who + "'s low-level policy");
}

void CheckMadeWith(const EnvConfig& env, const std::map<std::string, std::string>& made_with,
                   const std::string& who) {
  for (const auto& [key, value] : PolicyEnvironment(env)) {
    const auto found = made_with.find(key);
    if (found != made_with.end()) RequireSame(key, found->second, value, who);
  }
}

void CheckLowLevelMadeFor(const EnvConfig& env, const Policy& low_level, const std::string& who) {
  EnvConfig below = env;
  below.task = kLowLevelPolicysTask;
  CheckMadeFor(below, low_level, who);
}

}  // namespace skein
