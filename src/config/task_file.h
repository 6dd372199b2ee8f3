// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

#include "envs/tasks/terms/term_task_config.h"

namespace skein {

/// What the copy of the task file is called in the directory of a run.
inline constexpr const char* kTaskFileOfRun = "task.toml";

/// Whether what was given as a task is the path of a task file: it ends in .toml.
bool IsTaskFile(const std::string& task);

/// The text of the task file `path`. Throws Error if it cannot be read or is too long.
std::string ReadTaskFileText(const std::string& path);

/// What a task file says (docs/reference/task-files.md).
struct TaskFile {
  TermTaskConfig terms;
  toml::table settings;  ///< its tables of configuration keys: [env], [ppo] and so on
};

/// Reads the text of a task file, which errors call `source`. Throws Error that names the line and
/// the key: broken TOML, unknown keys and quantities (with the nearest known one), numbers that are
/// not finite or out of range, names given twice, more than TermTaskConfig's limits. Of `settings`
/// it reads nothing: those of `settings_tables`, the tables of configuration keys, are passed on.
TaskFile ReadTaskFile(const std::string& text, const std::string& source,
                      const std::vector<std::string>& settings_tables);

}  // namespace skein
