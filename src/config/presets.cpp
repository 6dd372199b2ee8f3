// SPDX-License-Identifier: Apache-2.0
#include "src/config/presets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "base/ends_with.h"
#include "base/error.h"
#include "base/nearest_name.h"

namespace skein {
namespace {

constexpr std::pair<const char*, const char*> kMeanings[] = {
    {"aerosonde", "another aircraft"},
    {"cessna172", "another aircraft"},
    {"default", "tuned for a small machine"},
    {"easy", "Heading with small changes"},
    {"paper", "the NeuralPlane paper's settings at 50 Hz"},
    {"planner", "Tracking by a high-level policy"},
    {"quick", "Heading in minutes"},
    {"robust", "under all conditions"}};

/// What `name`, which is none of the task's presets, `names`, may be: "; it is one of tracking";
/// empty if nothing is known.
std::string PresetMeant(const std::string& name, const std::vector<std::string>& names) {
  if (EndsWith(name, ".toml")) return "; a file of settings is given by --config";
  std::vector<std::string> tasks;
  for (const Preset& preset : Presets()) {
    if (name == preset.name) tasks.emplace_back(preset.task);
  }
  if (!tasks.empty()) return fmt::format("; it is one of {}", fmt::join(tasks, ", "));
  return DidYouMean(name, names);
}

}  // namespace

std::string PresetMeaning(const std::string& name) {
  for (const auto& [preset, meaning] : kMeanings) {
    if (name == preset) return meaning;
  }
  throw Error("nothing is said of presets called " + name);
}

std::vector<std::string> PresetTasks() {
  std::vector<std::string> tasks;
  for (const Preset& preset : Presets()) {
    if (std::find(tasks.begin(), tasks.end(), preset.task) == tasks.end()) {
      tasks.emplace_back(preset.task);
    }
  }
  return tasks;
}

std::string TaskHelp() {
  return fmt::format("what to fly: {}, or a task file, FILE.toml", fmt::join(PresetTasks(), ", "));
}

std::string PresetHelp() {
  std::vector<std::string> names;
  for (const Preset& preset : Presets()) {
    const std::string name = fmt::format("{} ({})", preset.name, PresetMeaning(preset.name));
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
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
  throw Error(fmt::format("unknown preset {} of task {}{}; known presets: {}", name, task,
                          PresetMeant(name, names), fmt::join(names, ", ")));
}

}  // namespace skein
