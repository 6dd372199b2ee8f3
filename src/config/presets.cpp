// SPDX-License-Identifier: Apache-2.0
#include "src/config/presets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/error.h"
#include "src/config/nearest_name.h"

namespace skein {

std::vector<std::string> PresetTasks() {
  std::vector<std::string> tasks;
  for (const Preset& preset : Presets()) {
    if (std::find(tasks.begin(), tasks.end(), preset.task) == tasks.end()) {
      tasks.emplace_back(preset.task);
    }
  }
  return tasks;
}

const Preset& FindPreset(const std::string& task, const std::string& name) {
  std::vector<std::string> names;
  for (const Preset& preset : Presets()) {
    if (task != preset.task) continue;
    if (name == preset.name) return preset;
    names.emplace_back(preset.name);
  }
  if (names.empty()) {
    throw Error(fmt::format("unknown task {}{}; known tasks: {}; a task file ends in .toml", task,
                            DidYouMean(task, PresetTasks()), fmt::join(PresetTasks(), ", ")));
  }
  throw Error(fmt::format("unknown preset {} of task {}; known presets: {}", name, task,
                          fmt::join(names, ", ")));
}

}  // namespace skein
