// SPDX-License-Identifier: Apache-2.0
// The manual and the completion scripts leave out no flag that a command's --help names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "tests/src/run_program.h"

namespace skein {
namespace {

using ::testing::HasSubstr;

/// A command as its own help shows it.
struct HelpedCommand {
  std::string path;  ///< "skein fdm trim"
  std::vector<std::string> flags;
};

/// "--help" of "  -h,--help       Print this ..."; empty if the line describes no flag.
std::string FlagOf(const std::string& line) {
  if (line.rfind("  -", 0) != 0) return "";
  const std::size_t begin = line.find("--");
  return line.substr(begin, line.find_first_of(", ", begin) - begin);
}

/// The command of these words and all below it, as their help tells.
void AppendHelped(const std::vector<std::string>& words, std::vector<HelpedCommand>* commands) {
  std::vector<std::string> arguments = words;
  arguments.push_back("--help");
  HelpedCommand command{"skein", {}};
  for (const std::string& word : words) command.path += " " + word;
  std::istringstream help(CallSkein(arguments).output);
  std::vector<std::string> below;
  bool lists_commands = false;
  for (std::string line; std::getline(help, line);) {
    if (line.empty()) lists_commands = false;
    if (lists_commands) below.push_back(line.substr(2, line.find(' ', 2) - 2));
    if (line == "Subcommands:") lists_commands = true;
    if (const std::string flag = FlagOf(line); !flag.empty()) command.flags.push_back(flag);
  }
  commands->push_back(command);
  for (const std::string& name : below) {
    arguments.back() = name;
    AppendHelped(arguments, commands);
  }
}

const std::vector<HelpedCommand>& HelpedCommands() {
  static const std::vector<HelpedCommand> commands = [] {
    std::vector<HelpedCommand> found;
    AppendHelped({}, &found);
    return found;
  }();
  return commands;
}

/// What lies between the first `begin` in `text` and the next `end` after it, or the text's end.
std::string Between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t at = text.find(begin);
  if (at == std::string::npos) return "";
  const std::size_t first = at + begin.size();
  return text.substr(first, text.find(end, first) - first);
}

std::string Replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size()) {
    text.replace(at, what.size(), by);
  }
  return text;
}

TEST(CommandTexts, HelpLeadsToEveryCommand) {
  std::vector<std::string> paths;
  for (const HelpedCommand& command : HelpedCommands()) {
    paths.push_back(command.path);
    EXPECT_THAT(command.flags, testing::Contains("--help")) << command.path;
  }
  EXPECT_THAT(paths, testing::IsSupersetOf({"skein", "skein train", "skein fdm trim",
                                            "skein bench signature", "skein plot"}));
}

TEST(CommandTexts, TheManualDescribesEveryFlag) {
  const std::string page = CallSkein({"man"}).output;
  for (const HelpedCommand& command : HelpedCommands()) {
    const bool is_program = command.path == "skein";
    const std::string section =
        is_program ? Between(page, ".SH OPTIONS\n", ".SH COMMANDS\n")
                   : Between(page, ".SS " + Replaced(command.path, "-", "\\-") + "\n", "\n.S");
    for (const std::string& flag : command.flags) {
      EXPECT_THAT(section, HasSubstr("\\fB" + Replaced(flag, "-", "\\-") + "\\fR")) << command.path;
    }
  }
}

TEST(CommandTexts, TheManualDescribesTheEnvironment) {
  const std::string section = Between(CallSkein({"man"}).output, ".SH ENVIRONMENT\n", "\n.SH");
  for (const std::string variable : {"SKEIN_SIMD", "CC", "SKEIN_PYTHON", "NO_COLOR"}) {
    EXPECT_THAT(section, HasSubstr("\n\\fB" + variable + "\\fR\n"));
  }
}

TEST(CommandTexts, BashCompletesEveryFlag) {
  const std::string script = CallSkein({"completion", "bash"}).output;
  for (const HelpedCommand& command : HelpedCommands()) {
    const std::string words = Between(script, "'" + command.path + "') words='", "' ;;") + " ";
    for (const std::string& flag : command.flags) {
      EXPECT_THAT(words, HasSubstr(flag + " ")) << command.path;
    }
  }
}

TEST(CommandTexts, ZshCompletesEveryFlag) {
  const std::string script = CallSkein({"completion", "zsh"}).output;
  for (const HelpedCommand& command : HelpedCommands()) {
    const std::string words =
        Between(script, "('" + command.path + "')\n      found=(", "\n      ;;\n");
    for (const std::string& flag : command.flags) {
      EXPECT_THAT(words, HasSubstr("'" + flag + ":")) << command.path;
    }
  }
}

TEST(CommandTexts, FishCompletesEveryFlag) {
  const std::string script = CallSkein({"completion", "fish"}).output;
  for (const HelpedCommand& command : HelpedCommands()) {
    const std::string line = "complete -c skein -n '__skein_at " + command.path + "'";
    std::string options;
    std::istringstream lines(script);
    for (std::string next; std::getline(lines, next);) {
      if (next.rfind(line, 0) == 0) options += next + "\n";
    }
    for (const std::string& flag : command.flags) {
      EXPECT_THAT(options, HasSubstr(" -l " + flag.substr(2) + " ")) << command.path;
    }
  }
}

}  // namespace
}  // namespace skein
