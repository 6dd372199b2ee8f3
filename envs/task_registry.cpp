// SPDX-License-Identifier: Apache-2.0
#include "envs/task_registry.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "envs/aircraft/registry.h"
#include "envs/tasks/control.h"
#include "envs/tasks/heading.h"
#include "envs/tasks/terms/term_task.h"
#include "envs/tasks/tracking.h"

namespace skein {
namespace {

struct Registration {
  const char* name;
  std::unique_ptr<Task> (*make)(const EnvConfig& config, const ReferenceUnits& units);
  bool is_hierarchical;
};

TargetLimits LimitsOf(const EnvConfig& config) {
  return {config.target_mach_min, config.target_altitude_min_ft, config.atmosphere};
}

/// Makes a task of its part of the configuration.
template <auto kMake, auto kConfig>
std::unique_ptr<Task> Make(const EnvConfig& config, const ReferenceUnits& units) {
  return kMake(config.*kConfig, units, LimitsOf(config));
}

constexpr std::array<Registration, 3> kTasks = {
    {{"heading", Make<MakeHeadingTask, &EnvConfig::heading>, false},
     {"control", Make<MakeControlTask, &EnvConfig::control>, false},
     {"tracking", Make<MakeTrackingTask, &EnvConfig::tracking>, true}}};

}  // namespace

std::vector<std::string> TaskNames() {
  std::vector<std::string> names;
  for (const Registration& task : kTasks) names.emplace_back(task.name);
  return names;
}

bool CanBeHierarchical(const std::string& name) {
  return std::any_of(kTasks.begin(), kTasks.end(), [&name](const Registration& task) {
    return name == task.name && task.is_hierarchical;
  });
}

bool NeedsLowLevel(const EnvConfig& config) {
  return CanBeHierarchical(config.task) && !config.tracking.acts_directly;
}

std::unique_ptr<Task> MakeTask(const EnvConfig& config) {
  if (config.term_task != nullptr) {
    return MakeTermTask(config.term_task, LoadAircraft(config.aircraft), LimitsOf(config));
  }
  std::string known;
  for (const Registration& task : kTasks) {
    if (config.task == task.name) return task.make(config, LoadAircraft(config.aircraft).units);
    known += (known.empty() ? "" : ", ") + std::string(task.name);
  }
  throw Error("environment: unknown task \"" + config.task + "\"; known: " + known +
              ", and task files");
}

}  // namespace skein
