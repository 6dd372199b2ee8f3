// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "base/error.h"
#include "envs/tasks/control.h"
#include "envs/tasks/heading.h"
#include "envs/tasks/task.h"
#include "envs/tasks/tracking.h"

namespace skein {
namespace {

struct Registration {
  const char* name;
  std::unique_ptr<Task> (*make)(const EnvConfig& config);
  bool is_hierarchical;
};

constexpr std::array<Registration, 3> kTasks = {{{"heading", MakeHeadingTask, false},
                                                 {"control", MakeControlTask, false},
                                                 {"tracking", MakeTrackingTask, true}}};

}  // namespace

std::vector<std::string> TaskNames() {
  std::vector<std::string> names;
  for (const Registration& task : kTasks) names.emplace_back(task.name);
  return names;
}

bool IsHierarchical(const std::string& name) {
  return std::any_of(kTasks.begin(), kTasks.end(), [&name](const Registration& task) {
    return name == task.name && task.is_hierarchical;
  });
}

std::unique_ptr<Task> MakeTask(const EnvConfig& config) {
  std::string known;
  for (const Registration& task : kTasks) {
    if (config.task == task.name) return task.make(config);
    known += (known.empty() ? "" : ", ") + std::string(task.name);
  }
  throw Error("environment: unknown task \"" + config.task + "\"; known: " + known);
}

}  // namespace skein
