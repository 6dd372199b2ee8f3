// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace skein {

/// The commands directly below `app`, in their order.
std::vector<const CLI::App*> CommandsOf(const CLI::App& app);

/// The options of a command by their long names, "--threads"; positional arguments are left out.
std::vector<std::string> OptionNames(const CLI::App& app);

/// Whether the command has `option`, "--threads" or "-o".
bool HasOption(const CLI::App& app, const std::string& option);

/// Makes `app` and the commands below it refuse an option in place of another one's value, which
/// the library would take: --out --threads 2.
void RefuseOptionsAsValues(CLI::App* app);

/// Calls values of `app` and the commands below it NUMBER that the library calls FLOAT, INT or
/// UINT.
void NameNumbers(CLI::App* app);

/// The command of `app` called `name`; null if there is none.
const CLI::App* FindCommand(const CLI::App& app, const std::string& name);

/// "unknown command trian; did you mean train?; known commands: train, eval".
std::string UnknownCommand(const CLI::App& app, const std::string& name);

}  // namespace skein
