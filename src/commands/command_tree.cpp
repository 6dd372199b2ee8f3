// SPDX-License-Identifier: Apache-2.0
#include "src/commands/command_tree.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include "base/nearest_name.h"
#include "src/commands/words_of_others.h"

namespace skein {

std::vector<const CLI::App*> CommandsOf(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> OptionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

bool HasOption(const CLI::App& app, const std::string& option) {
  return app.get_option_no_throw(option) != nullptr;
}

void RefuseOptionsAsValues(CLI::App* app) {
  for (CLI::Option* option : app->get_options()) {
    // Before its other checks.
    option->transform(CLI::Validator(
        [app](const std::string& value) {
          const bool is_option =
              value.rfind("--", 0) == 0 || (value.size() == 2 && HasOption(*app, value));
          return is_option ? fmt::format("a value is missing before {}", value) : std::string();
        },
        ""));
  }
  for (CLI::App* command : app->get_subcommands([](const CLI::App*) { return true; })) {
    RefuseOptionsAsValues(command);
  }
}

void NameNumbers(CLI::App* app) {
  for (CLI::Option* option : app->get_options()) {
    const std::string type = option->get_type_name();
    const std::string name = type.substr(0, type.find(':'));
    if (name == "FLOAT" || name == "INT" || name == "UINT") option->type_name("NUMBER");
  }
  for (CLI::App* command : app->get_subcommands([](const CLI::App*) { return true; })) {
    NameNumbers(command);
  }
}

const CLI::App* FindCommand(const CLI::App& app, const std::string& name) {
  for (const CLI::App* command : CommandsOf(app)) {
    if (command->get_name() == name) return command;
  }
  return nullptr;
}

std::string UnknownCommand(const CLI::App& app, const std::string& name) {
  std::vector<std::string> names;
  for (const CLI::App* command : CommandsOf(app)) names.push_back(command->get_name());
  std::string meant = app.get_parent() == nullptr ? CommandMeantElsewhere(name) : "";
  if (meant.empty()) meant = DidYouMean(name, names);
  return fmt::format("unknown command {}{}; known commands: {}", name, meant,
                     fmt::join(names, ", "));
}

}  // namespace skein
