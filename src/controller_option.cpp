#include "src/controller_option.h"

#include <fmt/format.h>

#include "envs/actions.h"
#include "envs/tasks/observation.h"
#include "envs/tasks/task.h"
#include "simd/error.h"
#include "src/policy_file.h"
#include "train/policy.h"

namespace skein {
namespace {

constexpr const char* kControllersTask = "control";

Policy LoadControlPolicy(const std::string& path) {
  Policy policy = Policy::Load(path);
  if (!policy.task().empty() && policy.task() != kControllersTask) {
    throw Error(
        fmt::format("--controller {}: a policy of task {}, but a planner needs one of "
                    "task {} below it",
                    path, policy.task(), kControllersTask));
  }
  if (policy.observation_size() != kObservationSize || policy.action_size() != kActionSize) {
    throw Error(
        fmt::format("--controller {}: it takes {} observations and gives {} actions, but "
                    "a policy of task {} has {} and {}",
                    path, policy.observation_size(), policy.action_size(), kControllersTask,
                    kObservationSize, kActionSize));
  }
  return policy;
}

}  // namespace

ChosenController ChooseController(const std::string& task, const std::string& option) {
  if (option.empty()) {
    if (!IsPlanned(task)) return {};
    throw Error(
        fmt::format("task {0} needs --controller RUN_OR_POLICY, a trained policy of task "
                    "{1} that flies what the planner asks for (`skein train {1}` makes one)",
                    task, kControllersTask));
  }
  if (!IsPlanned(task)) {
    throw Error(fmt::format("--controller is for tasks that are planned, not for {}", task));
  }
  const std::string path = PolicyFileOf(option);
  const auto policy = std::make_shared<const Policy>(LoadControlPolicy(path));
  std::string description = fmt::format("controller {}, an action every {} control steps; {}", path,
                                        policy->action_repeat(), Describe(policy->backend()));
  if (policy->task().empty()) {
    description += fmt::format(" (it does not say its task, which should be {})", kControllersTask);
  }
  return {policy, description};
}

}  // namespace skein
