#include "train/policy/autopilot_policy.h"

#include "envs/autopilot/autopilot.h"

namespace skein {
namespace {

std::unique_ptr<const Pilot> ControlAutopilot(const std::string& variant, const EnvConfig& env) {
  EnvConfig config = env;
  config.task = "control";
  return MakeAutopilot(config, AutopilotOf(variant));
}

}  // namespace

AutopilotController::AutopilotController(const std::string& variant, const EnvConfig& env)
    : variant_(variant),
      control_interval_s_(env.control_interval_s),
      autopilot_(ControlAutopilot(variant, env)) {}

}  // namespace skein
