// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skein {

/// A TOML file of configs/<task>/<name>.toml, embedded in the program.
struct Preset {
  const char* task;
  const char* name;
  const std::string_view* text;
};

const std::vector<Preset>& Presets();

/// Throws Error that lists what there is if the task or the preset is unknown.
const Preset& FindPreset(const std::string& task, const std::string& name);

/// Where the settings of a task file begin: configs/task_file.toml, embedded in the program.
std::string_view TaskFileSettings();

/// The tasks that have presets.
std::vector<std::string> PresetTasks();

/// What an option takes that names a task, for help: those, or a task file.
std::string TaskHelp();

/// What presets of this name are for: "under all conditions".
std::string PresetMeaning(const std::string& name);

/// The names of the presets, each once, with what they are for, for help: "default (...), ...".
std::string PresetHelp();

}  // namespace skein
