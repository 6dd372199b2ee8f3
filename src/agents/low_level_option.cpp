// SPDX-License-Identifier: Apache-2.0
#include "src/agents/low_level_option.h"

#include <fmt/format.h>

#include "base/choice_error.h"
#include "base/error.h"
#include "envs/actions.h"
#include "envs/task_registry.h"
#include "envs/tasks/observation.h"
#include "src/agents/agent_names.h"
#include "src/agents/policy_file.h"
#include "src/config/usage_error.h"
#include "train/policy/autopilot_policy.h"
#include "train/policy/low_level_file.h"
#include "train/policy/policy_environment.h"
#include "train/policy/recurrent_policy.h"

namespace skein {
namespace {

RecurrentPolicy LoadControlPolicy(const EnvConfig& env, const std::string& path) {
  RecurrentPolicy policy = RecurrentPolicy::Load(path);
  if (!policy.task().empty() && policy.task() != kLowLevelTask) {
    throw ChoiceError(
        fmt::format("--low-level {}: a policy of task {}, but a high-level policy needs one of "
                    "task {} below it",
                    path, policy.task(), kLowLevelTask));
  }
  if (policy.observation_size() != kObservationSize || policy.action_size() != kActionSize) {
    throw ChoiceError(
        fmt::format("--low-level {}: it takes {} observations and gives {} actions, but "
                    "a policy of task {} has {} and {}",
                    path, policy.observation_size(), policy.action_size(), kLowLevelTask,
                    kObservationSize, kActionSize));
  }
  CheckLowLevelMadeFor(env, policy, "--low-level " + path);
  return policy;
}

ChosenLowLevelPolicy ChooseAutopilot(const EnvConfig& env, const std::string& option) {
  const std::string variant = AutopilotVariantOf(option);
  return {AsUsage([&] { return std::make_shared<const AutopilotPolicy>(variant, env); }),
          fmt::format("low-level policy: the autopilot, variant {}", variant)};
}

}  // namespace

ChosenLowLevelPolicy ChooseLowLevelPolicy(const EnvConfig& env, const std::string& option) {
  const std::string& task = env.task;
  if (option.empty()) {
    if (!NeedsLowLevel(env)) return {};
    throw UsageError(fmt::format(
        "task {0}, flown by a high-level policy, needs --low-level RUN_OR_POLICY, a low-level "
        "policy trained on task "
        "{1} (`skein train {1}` makes one), or --low-level autopilot; the default preset trains "
        "a policy without one",
        task, kLowLevelTask));
  }
  if (!NeedsLowLevel(env)) {
    throw UsageError(
        fmt::format("--low-level is for tasks of a high-level policy, not for {}{}", task,
                    CanBeHierarchical(task) ? " flown directly: --preset planner" : ""));
  }
  if (IsAutopilot(option)) {
    return ChooseAutopilot(env, option);
  }
  const std::string path = PolicyFileOf(option);
  const auto policy = std::make_shared<const RecurrentPolicy>(LoadControlPolicy(env, path));
  std::string description = fmt::format("low-level policy {}, an action every {} control steps; {}",
                                        path, policy->action_repeat(), Describe(policy->backend()));
  if (policy->task().empty()) {
    description += fmt::format(" (it does not say its task, which should be {})", kLowLevelTask);
  }
  return {policy, description};
}

ChosenLowLevelPolicy ChooseLowLevelPolicy(const EnvConfig& env, const std::string& option,
                                          const std::string& from) {
  if (option.empty() && !from.empty() && NeedsLowLevel(env)) {
    auto own = LoadLowLevelPolicy(TensorFile::Read(from), from);
    if (own != nullptr) return {std::move(own), "low-level policy of " + from};
  }
  return ChooseLowLevelPolicy(env, option);
}

}  // namespace skein
