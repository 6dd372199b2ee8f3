// SPDX-License-Identifier: Apache-2.0
#include "src/config/key_reference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <vector>

#include "base/field_list.h"
#include "envs/task_registry.h"
#include "src/config/configuration.h"
#include "src/config/settings.h"

namespace skein {
namespace {

constexpr const char* kIntroduction = R"(<!-- Written by `skein train --help-keys=markdown`. -->
# Configuration keys

A key is set by `--set KEY=VALUE`, or in a TOML file, where the dots are tables (`[env.heading]`, `altitude_change_ft = 3000`).
From lowest to highest precedence: built-in defaults, preset, `--config`, `--condition`, `--set`. Units are in the names. Whole numbers may be
written as 1.35e9, and on the command line as 10M (k, M, G). An unknown key, one that a file gives twice, a key of another task than the one that is flown, a wrong type
and a value out of range are errors. `skein train TASK --help-keys` prints this list with the values of a preset and a file.

The values below are those of the presets of task )";

std::string TypeText(const Field& field) {
  const std::string bounds = field.BoundsText();
  return field.TypeName() + (bounds.empty() ? "" : " in " + bounds);
}

/// The first task to which the field means something.
std::string FirstTaskOf(const Field& field) {
  return field.tasks.empty() ? TaskNames().front() : field.tasks.front();
}

/// The values of two presets of a task.
struct PresetValues {
  ProgramConfig usual, paper;
  std::vector<Field> usual_fields, paper_fields;

  explicit PresetValues(const std::string& task)
      : usual(ResolveConfig({task, "default", "", {}})),
        paper(ResolveConfig({task, "paper", "", {}})),
        usual_fields(FieldsOf(usual)),
        paper_fields(FieldsOf(paper)) {}
  PresetValues(const PresetValues&) = delete;  // the fields point into it
  PresetValues& operator=(const PresetValues&) = delete;
};

/// Of the keys of all tasks those that the presets of `task` set otherwise than the first task's.
std::string RowsOfTask(const std::string& task) {
  PresetValues first(TaskNames().front()), own(task);
  std::string rows;
  const auto add = [&](const Field& theirs, const Field& ours, const char* preset) {
    const std::string value = TomlText(ours);
    if (!ours.tasks.empty() || ours.key == "env.task" || value == TomlText(theirs)) return;
    rows += fmt::format("| `{}` | `{}` | `{}` | {} |\n", task, ours.key, preset, value);
  };
  for (std::size_t i = 0; i < own.usual_fields.size(); ++i) {
    add(first.usual_fields[i], own.usual_fields[i], "default");
  }
  for (std::size_t i = 0; i < own.paper_fields.size(); ++i) {
    add(first.paper_fields[i], own.paper_fields[i], "paper");
  }
  return rows;
}

/// The row of the key number `i`.
std::string KeyRow(const PresetValues& values, std::size_t i) {
  const Field& field = values.usual_fields[i];
  const std::string usual = TomlText(field), paper = TomlText(values.paper_fields[i]);
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", field.key, TypeText(field), usual,
                     usual == paper ? "" : paper, field.help);
}

}  // namespace

std::string DescribeKeys(const ProgramConfig& config) {
  ProgramConfig listed = config;
  std::string text;
  for (const Field& field : FieldsOf(listed)) {
    const std::string whose =
        field.tasks.empty() ? "" : fmt::format(" (task {})", fmt::join(field.tasks, ", "));
    text += fmt::format("{} = {}\n    {}: {}{}\n", field.key, TomlText(field), TypeText(field),
                        field.help, whose);
  }
  return text;
}

std::string DescribeKeysMarkdown() {
  const std::vector<std::string> tasks = TaskNames();
  std::string text = kIntroduction;
  text += fmt::format(
      "{}, and of a task's own keys those of that task's presets\n([tasks.md](tasks.md)). The "
      "presets of the other tasks differ from them in\n\n| task | key | preset | value |\n"
      "|---|---|---|---|\n",
      tasks.front());
  std::map<std::string, PresetValues> values;
  for (const std::string& task : tasks) {
    text += RowsOfTask(task);
    values.emplace(task, task);
  }
  text +=
      "\nAll keys:\n\n| key | type | `default` | `paper`, if another | meaning |\n"
      "|---|---|---|---|---|\n";
  const std::vector<Field>& fields = values.at(tasks.front()).usual_fields;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    text += KeyRow(values.at(FirstTaskOf(fields[i])), i);
  }
  return text;
}

}  // namespace skein
