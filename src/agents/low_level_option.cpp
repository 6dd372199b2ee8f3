#include "src/agents/low_level_option.h"

#include <fmt/format.h>

#include "envs/actions.h"
#include "envs/tasks/observation.h"
#include "envs/tasks/task.h"
#include "base/error.h"
#include "src/agents/policy_file.h"
#include "train/policy/autopilot_policy.h"
#include "train/policy/low_level_file.h"
#include "train/policy/recurrent_policy.h"
#include "train/policy/policy_environment.h"

namespace skein {
namespace {

constexpr const char* kControllersTask = "control";
constexpr const char* kAutopilot = "autopilot";
constexpr const char* kPlannersVariant = "parallel";  ///< nose and speed at once, as a planner asks

Policy LoadControlPolicy(const EnvConfig& env, const std::string& path) {
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
  CheckControllerMadeFor(env, policy, "--controller " + path);
  return policy;
}

ChosenController ChooseAutopilot(const EnvConfig& env, const std::string& option) {
  const std::string variant =
      option == kAutopilot ? kPlannersVariant : option.substr(option.find(':') + 1);
  return {std::make_shared<const AutopilotController>(variant, env),
          fmt::format("controller: the traditional autopilot, {}", variant)};
}

}  // namespace

ChosenController ChooseController(const EnvConfig& env, const std::string& option) {
  const std::string& task = env.task;
  if (option.empty()) {
    if (!IsPlanned(task)) return {};
    throw Error(
        fmt::format("task {0} needs --controller RUN_OR_POLICY, a trained policy of task "
                    "{1} that flies what the planner asks for (`skein train {1}` makes one), or "
                    "--controller autopilot",
                    task, kControllersTask));
  }
  if (!IsPlanned(task)) {
    throw Error(fmt::format("--controller is for tasks that are planned, not for {}", task));
  }
  if (option == kAutopilot || option.rfind(kAutopilot + std::string(":"), 0) == 0) {
    return ChooseAutopilot(env, option);
  }
  const std::string path = PolicyFileOf(option);
  const auto policy = std::make_shared<const Policy>(LoadControlPolicy(env, path));
  std::string description = fmt::format("controller {}, an action every {} control steps; {}", path,
                                        policy->action_repeat(), Describe(policy->backend()));
  if (policy->task().empty()) {
    description += fmt::format(" (it does not say its task, which should be {})", kControllersTask);
  }
  return {policy, description};
}

std::shared_ptr<const Pilot> ControllerOfRun(const RunDirectory& directory,
                                             const std::string& task) {
  if (!IsPlanned(task)) return nullptr;
  const std::string path = directory.controller();
  std::shared_ptr<const Pilot> controller = LoadController(TensorFile::Read(path), path);
  if (controller == nullptr) throw Error(fmt::format("{}: it holds no controller", path));
  return controller;
}

}  // namespace skein
