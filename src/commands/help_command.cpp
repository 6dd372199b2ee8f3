// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "src/commands/command_tree.h"
#include "src/commands/commands.h"
#include "src/config/usage_error.h"

namespace skein {
namespace {

/// Prints what `skein PATH --help` prints.
void PrintHelp(const CLI::App& program, const std::vector<std::string>& path) {
  const CLI::App* command = &program;
  std::string parents;
  for (const std::string& name : path) {
    parents += (parents.empty() ? "" : " ") + command->get_name();
    const CLI::App* const next = FindCommand(*command, name);
    if (next == nullptr) throw UsageError("help: " + UnknownCommand(*command, name));
    command = next;
  }
  // The program's own help would be that of the command that was parsed, which is this one.
  if (command == &program) {
    fmt::print(
        "{}", CLI::Formatter().make_help(&program, program.get_name(), CLI::AppFormatMode::Normal));
    return;
  }
  fmt::print("{}", command->help(parents));
}

}  // namespace

void AddHelpCommand(CLI::App* app) {
  auto path = std::make_shared<std::vector<std::string>>();
  CLI::App* command = app->add_subcommand("help", "Show the help of a command, as its --help does");
  command->add_option("command", *path, "the command (default: the program itself)")
      ->type_name("COMMAND");
  command->footer("Example: skein help fdm trim");
  command->callback([app, path] { PrintHelp(*app, *path); });
}

}  // namespace skein
