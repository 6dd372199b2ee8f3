// SPDX-License-Identifier: Apache-2.0
#include "train/policy/autopilot_policy.h"

#include "base/error.h"
#include "envs/autopilot/autopilot.h"
#include "train/files/tensor_access.h"
#include "train/policy/policy_environment.h"

namespace skein {
namespace {

constexpr const char* kVariantKey = "autopilot";
constexpr const char* kIntervalKey = "control_interval_s";

std::unique_ptr<const Policy> ControlAutopilot(const std::string& variant, const EnvConfig& env) {
  EnvConfig config = env;
  config.task = kLowLevelTask;
  // A file does not say in which plant it flew: of any one, and bit for bit, it flies by one
  // throttle.
  return MakeAutopilot(config, GainsOf(AutopilotOf(variant)));
}

}  // namespace

AutopilotPolicy::AutopilotPolicy(const std::string& variant, const EnvConfig& env)
    : variant_(variant),
      control_interval_s_(env.control_interval_s),
      autopilot_(ControlAutopilot(variant, env)) {}

std::shared_ptr<const AutopilotPolicy> AutopilotPolicy::Load(const TensorFile& file,
                                                             const std::string& path) {
  const auto variant = file.metadata.find(kVariantKey);
  if (variant == file.metadata.end()) return nullptr;
  const auto interval = file.metadata.find(kIntervalKey);
  // Of the environment that it flew in: whether another fits is for CheckMadeFor to say.
  EnvConfig env;
  env.control_interval_s =
      interval == file.metadata.end() ? 0 : ToNumber(interval->second, path, kIntervalKey);
  if (!(env.control_interval_s > 0)) {
    throw Error(path + ": it does not say at which interval the autopilot flies");
  }
  try {
    return std::make_shared<const AutopilotPolicy>(variant->second, env);
  } catch (const Error& error) {
    throw Error(path + ": " + error.what());
  }
}

void AutopilotPolicy::CheckMadeFor(const EnvConfig& env, const std::string& who) const {
  EnvConfig own;
  own.control_interval_s = control_interval_s_;
  CheckMadeWith(env, {{kIntervalKey, PolicyEnvironment(own).at(kIntervalKey)}}, who);
  try {
    AutopilotPolicy(variant_, env);
  } catch (const Error& error) {
    throw Error(who + ": " + error.what());
  }
}

void AutopilotPolicy::Store(TensorFile& file) const {
  file.metadata[kVariantKey] = variant_;
  file.metadata[kIntervalKey] = ExactText(control_interval_s_);
}

std::shared_ptr<const StoredPolicy> AutopilotPolicy::OnBackend(Backend /*backend*/) const {
  return std::make_shared<const AutopilotPolicy>(*this);
}

}  // namespace skein
