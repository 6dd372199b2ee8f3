// SPDX-License-Identifier: Apache-2.0
#include "src/commands/command_forms.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "src/commands/command_tree.h"
#include "src/config/conditions.h"
#include "src/config/presets.h"

namespace skein {
namespace {

/// The names in the braces of "TEXT:{float64,float32}", which is how CLI11 lists them.
std::vector<std::string> NamesInBraces(const std::string& type) {
  const std::size_t begin = type.find('{'), end = type.find('}');
  std::vector<std::string> names;
  if (begin == std::string::npos || end == std::string::npos) return names;
  std::istringstream list(type.substr(begin + 1, end - begin - 1));
  for (std::string name; std::getline(list, name, ',');) names.push_back(name);
  return names;
}

std::vector<std::string> PresetNames() {
  std::vector<std::string> names;
  for (const Preset& preset : Presets()) {
    if (std::find(names.begin(), names.end(), preset.name) == names.end()) {
      names.emplace_back(preset.name);
    }
  }
  return names;
}

std::vector<std::string> CommandNames(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : CommandsOf(program)) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> ConditionLevels() {
  std::vector<std::string> levels;
  for (const ConditionForm& form : ConditionForms()) {
    for (const char* level : {"=mild", "=middle", "=hard"}) {
      levels.push_back(std::string(form.name) + level);
    }
  }
  return levels;
}

/// By the name of its type, which is how the commands of `program` say what a value is.
std::vector<std::string> ChoicesOf(const std::string& type, const CLI::App& program) {
  if (type == "COMMAND") return CommandNames(program);
  if (type == "TASK") return PresetTasks();
  if (type == "PRESET") return PresetNames();
  if (type == "NAME=LEVEL") return ConditionLevels();
  return NamesInBraces(type);
}

OptionForm FormOf(const CLI::Option& option, const CLI::App& program) {
  OptionForm form;
  for (const std::string& name : option.get_snames()) form.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) form.names.push_back("--" + name);
  form.is_argument = form.names.empty();
  if (form.is_argument) form.names.push_back(option.get_name(true));
  const std::string type = option.get_type_name();
  form.choices = ChoicesOf(type, program);
  form.value = type.substr(0, type.find(':'));
  form.is_path = form.value.find("FILE") != std::string::npos ||
                 form.value.find("DIR") != std::string::npos ||
                 form.value.find("RUN") != std::string::npos;
  form.description = option.get_description();
  return form;
}

/// `app` and the commands below it.
void Append(const CLI::App& app, const CLI::App& program, const std::string& parents,
            std::vector<CommandForm>* forms) {
  CommandForm form;
  form.path = parents + app.get_name();
  form.app = &app;
  for (const CLI::Option* option : app.get_options()) {
    form.options.push_back(FormOf(*option, program));
  }
  form.commands = CommandsOf(app);
  const std::string path = form.path + " ";
  forms->push_back(std::move(form));
  for (const CLI::App* command : CommandsOf(app)) {
    Append(*command, program, path, forms);
  }
}

}  // namespace

std::vector<CommandForm> CommandForms(const CLI::App& program) {
  std::vector<CommandForm> forms;
  Append(program, program, "", &forms);
  return forms;
}

}  // namespace skein
