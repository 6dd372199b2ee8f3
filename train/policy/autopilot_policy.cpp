// SPDX-License-Identifier: Apache-2.0
#include "train/policy/autopilot_policy.h"

#include "envs/autopilot/autopilot.h"

namespace skein {
namespace {

std::unique_ptr<const Policy> ControlAutopilot(const std::string& variant, const EnvConfig& env) {
  EnvConfig config = env;
  config.task = "control";
  return MakeAutopilot(config, AutopilotOf(variant));
}

}  // namespace

AutopilotPolicy::AutopilotPolicy(const std::string& variant, const EnvConfig& env)
    : variant_(variant),
      control_interval_s_(env.control_interval_s),
      autopilot_(ControlAutopilot(variant, env)) {}

}  // namespace skein
