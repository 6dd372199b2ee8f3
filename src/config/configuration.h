// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/config/program_config.h"

namespace skein {

/// Applies TOML text to `config`. Throws Error with `source` and the line: broken TOML, unknown
/// keys (with the nearest known one, or what a key of older versions is called now), keys of other
/// tasks than the configuration's, wrong types and values out of range.
void ApplyToml(const std::string& text, const std::string& source, ProgramConfig* config);

/// Applies the TOML file `path`. Throws Error if it cannot be read.
void ApplyTomlFile(const std::string& path, ProgramConfig* config);

/// The configuration that a run has recorded in the file `path`, with the task file beside it if it
/// names one. One by an older version, with keys of other tasks or by their former names, is
/// understood. Throws Error as ApplyToml.
ProgramConfig ReadRecord(const std::string& path);

/// Applies conditions (src/config/conditions.h), then assignments `key=value`, whose values are
/// TOML; names need no quotes, and numbers may end in k, M or G. Errors say `source` of
/// assignments.
void ApplyConditionsAndAssignments(const std::vector<std::string>& conditions,
                                   const std::vector<std::string>& assignments,
                                   ProgramConfig* config, const std::string& source = "--set");

/// Assignments for flights that go on for `hold_s` after their target was reached, or for missions
/// of `mission_min` minutes; none for what is not asked for.
std::vector<std::string> FlightLengthAssignments(std::optional<double> hold_s,
                                                 std::optional<double> mission_min);

/// The key of an assignment `key=value`; of anything else, all of it.
std::string KeyOf(const std::string& assignment);
/// The name, with quotes or without, that an assignment gives `key`; empty if it gives none.
std::string NameAssigned(const std::string& assignment, const std::string& key);

/// Throws Error, which calls what was read `source`, unless `env` is of the task that is `asked`
/// for. Keys may repeat which one that is, as the configuration of a run does.
void RequireTask(const EnvConfig& env, const EnvConfig& asked,
                 const std::string& source = "the configuration");

/// Throws Error on values that are each allowed but cannot go together.
void CheckConsistent(const ProgramConfig& config);

/// The same of what evaluations fly, which heed nothing that only serves training.
void CheckFlyable(const EnvConfig& env);

/// Where a configuration comes from, before it is resolved.
struct ConfigSources {
  std::string task;    ///< the preset's folder, and env.task; or the path of a task file
  std::string preset;  ///< name of a preset of the task
  std::string file;    ///< TOML file, or empty
  std::vector<std::string> assignments;
  std::vector<std::string> conditions = {};  ///< NAME=LEVEL, of lower precedence than assignments
  std::string assignments_are = "--set";     ///< what errors call an assignment
  std::string task_text = "";                ///< text of a task file, which errors then call `task`
  /// NAME#HASH for the path of an aircraft's file in `task_text`; empty: not known, and passed
  /// over.
  std::string text_aircraft = "";
  bool is_beginning = false;  ///< more comes on top: RequireScaleOfTaskFile is for later
};

/// The path of the aircraft's file that the TOML file `path`, a configuration or a task file,
/// names, from where the program runs; empty if it names none. Throws Error on a file that is no
/// TOML.
std::string AircraftFileNamedIn(const std::string& path);

/// The name of the task that was asked for: of a task file the one that it says.
std::string TaskNameOf(const std::string& task);

/// What the text of a task file, which errors call `source`, says of the task.
TermTaskConfig TermTaskIn(const std::string& text, const std::string& source);

/// As env.task_file_hash.
std::string TaskFileHash(const std::string& path);

/// Defaults, then preset, then file, then conditions, then assignments. The preset of a task file
/// is its own tables of settings, on top of TaskFileSettings. Throws Error if one of them names
/// another task.
ProgramConfig ResolveConfig(const ConfigSources& sources);

/// Throws Error as RequireOwnScale if the aircraft is another than the one that the settings of
/// task files begin with. Other tasks pass.
void RequireScaleOfTaskFile(const ProgramConfig& config);

/// Every key of the configuration's task with its value, as TOML that ApplyToml reads back exactly,
/// each with its meaning.
std::string DumpToml(const ProgramConfig& config);

/// The keys of their tasks whose values differ, as "key (ours against theirs)".
std::vector<std::string> Differences(const ProgramConfig& a, const ProgramConfig& b);

}  // namespace skein
