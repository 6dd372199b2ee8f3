#include "train/policy/policy_environment.h"

#include <charconv>

#include "base/name_in.h"
#include "envs/tasks/task.h"
#include "base/error.h"
#include "train/policy/autopilot_policy.h"
#include "train/policy/policy_parameters.h"

namespace skein {
namespace {

constexpr const char* kControllersTask = "control";
constexpr const char* kErrorAxes = "tracking.error_axes";
constexpr const char* kAveragesObservations = "planner.averages_observations";

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

void CheckAutopilot(const EnvConfig& env, const AutopilotController& autopilot,
                    const std::string& who) {
  RequireSame("control_interval_s", Text(autopilot.control_interval_s()),
              Text(env.control_interval_s), who);
  try {
    AutopilotController(autopilot.variant(), env);
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
  if (!IsPlanned(env.task)) return environment;
  environment["planner.pitch_change_rad"] = Text(env.planner.pitch_change_rad);
  environment["planner.yaw_change_rad"] = Text(env.planner.yaw_change_rad);
  environment["planner.speed_change_fps"] = Text(env.planner.speed_change_fps);
  environment[kAveragesObservations] = env.planner.averages_observations ? "true" : "false";
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
    env->planner.averages_observations = found->second == "true";
  }
}

void CheckMadeFor(const EnvConfig& env, const Pilot& pilot, const std::string& who) {
  if (const auto* const autopilot = dynamic_cast<const AutopilotController*>(&pilot)) {
    CheckAutopilot(env, *autopilot, who);
    return;
  }
  const auto* const policy = dynamic_cast<const Policy*>(&pilot);
  if (policy == nullptr) return;
  if (!policy->task().empty()) RequireSame("task", policy->task(), env.task, who);
  CheckMadeWith(env, policy->parameters()->environment, who);
  if (policy->controller() == nullptr) return;
  CheckControllerMadeFor(env, *policy->controller(), who + "'s controller");
}

void CheckMadeWith(const EnvConfig& env, const std::map<std::string, std::string>& made_with,
                   const std::string& who) {
  for (const auto& [key, value] : PolicyEnvironment(env)) {
    const auto found = made_with.find(key);
    if (found != made_with.end()) RequireSame(key, found->second, value, who);
  }
}

void CheckControllerMadeFor(const EnvConfig& env, const Pilot& controller, const std::string& who) {
  EnvConfig below = env;
  below.task = kControllersTask;
  CheckMadeFor(below, controller, who);
}

}  // namespace skein
