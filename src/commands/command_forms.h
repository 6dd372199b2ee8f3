// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace skein {

/// An option or argument of a command as completion scripts and the manual show it.
struct OptionForm {
  std::vector<std::string> names;    ///< "-h", "--help"; of an argument without dashes its one name
  bool is_argument = false;          ///< without dashes
  std::string value;                 ///< "FILE"; empty for a flag
  bool is_path = false;              ///< its value is a file or directory
  std::vector<std::string> choices;  ///< values that it may have, as far as they can be listed
  std::string description;
};

/// A command with everything that can follow it.
struct CommandForm {
  std::string path;  ///< "skein fdm trim"
  const CLI::App* app = nullptr;
  std::vector<OptionForm> options;
  std::vector<const CLI::App*> commands;  ///< directly below it
};

/// `program` and every command below it, each before its own.
std::vector<CommandForm> CommandForms(const CLI::App& program);

}  // namespace skein
