// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "src/commands/command_forms.h"
#include "src/commands/commands.h"
#include "src/config/one_of.h"
#include "src/files/shell_text.h"

namespace skein {
namespace {

/// The first long name of an option, which is what is completed.
const std::string& NameOf(const OptionForm& option) {
  const auto is_long = [](const std::string& name) { return name.rfind("--", 0) == 0; };
  const auto found = std::find_if(option.names.begin(), option.names.end(), is_long);
  return found == option.names.end() ? option.names.back() : *found;
}

/// What may follow a command: commands, choices of its arguments, options.
std::vector<std::string> WordsAfter(const CommandForm& command) {
  std::vector<std::string> words;
  for (const CLI::App* below : command.commands) words.push_back(below->get_name());
  for (const OptionForm& option : command.options) {
    if (option.is_argument) {
      words.insert(words.end(), option.choices.begin(), option.choices.end());
    } else {
      words.push_back(NameOf(option));
    }
  }
  return words;
}

/// Every command but the program itself, each quoted, between `separator`s.
std::string QuotedPaths(const std::vector<CommandForm>& commands, const char* separator) {
  std::vector<std::string> paths;
  for (std::size_t i = 1; i < commands.size(); ++i) paths.push_back(SingleQuoted(commands[i].path));
  return fmt::format("{}", fmt::join(paths, separator));
}

/// Calls visit(command and option as typed, option) for every name of every option that takes a
/// value.
template <typename Visit>
void VisitValues(const std::vector<CommandForm>& commands, const Visit& visit) {
  for (const CommandForm& command : commands) {
    for (const OptionForm& option : command.options) {
      if (option.is_argument || option.value.empty()) continue;
      for (const std::string& name : option.names) {
        visit(SingleQuoted(command.path + " " + name), option);
      }
    }
  }
}

std::string Bash(const std::vector<CommandForm>& commands) {
  std::string text = fmt::format(
      "# Completion of skein for bash; made by `skein completion bash`.\n"
      "_skein() {{\n"
      "  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}\n"
      "  local at=skein words= i\n"
      "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
      "    case \"$at ${{COMP_WORDS[i]}}\" in\n"
      "      {}) at+=\" ${{COMP_WORDS[i]}}\" ;;\n"
      "    esac\n"
      "  done\n"
      "  case \"$at $previous\" in\n",
      QuotedPaths(commands, " | "));
  VisitValues(commands, [&text](const std::string& typed, const OptionForm& option) {
    // Without words the shell completes names of files.
    text += fmt::format("    {}) words={} ;;\n", typed,
                        SingleQuoted(fmt::format("{}", fmt::join(option.choices, " "))));
  });
  text += "    *)\n      case \"$at\" in\n";
  for (const CommandForm& command : commands) {
    text += fmt::format("        {}) words={} ;;\n", SingleQuoted(command.path),
                        SingleQuoted(fmt::format("{}", fmt::join(WordsAfter(command), " "))));
  }
  return text +
         "      esac\n"
         "      ;;\n"
         "  esac\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
         "}\n"
         "complete -o bashdefault -o default -F _skein skein\n";
}

/// "name:description" for zsh's _describe.
std::string Described(const std::string& name, const std::string& description) {
  return SingleQuoted(name + ":" + description);
}

std::string Zsh(const std::vector<CommandForm>& commands) {
  std::string text = fmt::format(
      "#compdef skein\n"
      "# Completion of skein for zsh; made by `skein completion zsh`.\n"
      "_skein() {{\n"
      "  local at=skein word\n"
      "  local -a found\n"
      "  for word in \"${{(@)words[2,CURRENT-1]}}\"; do\n"
      "    case \"$at $word\" in\n"
      "      ({}) at+=\" $word\" ;;\n"
      "    esac\n"
      "  done\n"
      "  case \"$at ${{words[CURRENT-1]}}\" in\n",
      QuotedPaths(commands, "|"));
  VisitValues(commands, [&text](const std::string& typed, const OptionForm& option) {
    text += option.choices.empty() ? fmt::format("    ({}) _files; return ;;\n", typed)
                                   : fmt::format("    ({}) compadd {}; return ;;\n", typed,
                                                 fmt::join(option.choices, " "));
  });
  text += "  esac\n  case \"$at\" in\n";
  for (const CommandForm& command : commands) {
    std::vector<std::string> words;
    for (const CLI::App* below : command.commands) {
      words.push_back(Described(below->get_name(), below->get_description()));
    }
    for (const OptionForm& option : command.options) {
      for (const std::string& choice : option.choices) {
        if (option.is_argument) words.push_back(Described(choice, option.value));
      }
      if (!option.is_argument) words.push_back(Described(NameOf(option), option.description));
    }
    text += fmt::format("    ({})\n      found=({})\n      ;;\n", SingleQuoted(command.path),
                        fmt::join(words, "\n             "));
  }
  return text +
         "  esac\n"
         "  _describe skein found || _files\n"
         "}\n"
         "compdef _skein skein\n"
         "if [ \"$funcstack[1]\" = _skein ]; then _skein \"$@\"; fi\n";
}

/// In single quotes as fish reads them.
std::string FishQuoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "'";
}

std::string FishOption(const OptionForm& option) {
  std::string line;
  for (const std::string& name : option.names) {
    if (option.is_argument) break;
    const bool is_long = name.rfind("--", 0) == 0;
    line += is_long ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (!option.is_argument && !option.value.empty()) line += option.is_path ? " -r -F" : " -x";
  if (!option.choices.empty()) {
    line += " -a " + FishQuoted(fmt::format("{}", fmt::join(option.choices, " ")));
  }
  return line.empty() ? "" : line + " -d " + FishQuoted(option.description);
}

std::string Fish(const std::vector<CommandForm>& commands) {
  std::string text = fmt::format(
      "# Completion of skein for fish; made by `skein completion fish`.\n"
      "function __skein_at\n"
      "    set -l at skein\n"
      "    for word in (commandline -opc)[2..]\n"
      "        switch \"$at $word\"\n"
      "            case {}\n"
      "                set at \"$at $word\"\n"
      "        end\n"
      "    end\n"
      "    test \"$at\" = \"$argv\"\n"
      "end\n",
      QuotedPaths(commands, " "));
  for (const CommandForm& command : commands) {
    const std::string line =
        fmt::format("complete -c skein -n {}", FishQuoted("__skein_at " + command.path));
    for (const CLI::App* below : command.commands) {
      text += fmt::format("{} -f -a {} -d {}\n", line, below->get_name(),
                          FishQuoted(below->get_description()));
    }
    for (const OptionForm& option : command.options) {
      const std::string form = FishOption(option);
      if (!form.empty()) text += line + form + "\n";
    }
  }
  return text;
}

}  // namespace

void AddCompletionCommand(CLI::App* app) {
  auto shell = std::make_shared<std::string>();
  CLI::App* command = app->add_subcommand("completion", "Print a completion script for a shell");
  command->add_option("shell", *shell, "whose script")
      ->type_name("SHELL")
      ->required()
      ->check(OneOf(std::vector<std::string>{"bash", "zsh", "fish"}));
  command->footer("Installed with the program; without, for bash: source <(skein completion bash)");
  command->callback([app, shell] {
    const std::vector<CommandForm> commands = CommandForms(*app);
    if (*shell == "bash") fmt::print("{}", Bash(commands));
    if (*shell == "zsh") fmt::print("{}", Zsh(commands));
    if (*shell == "fish") fmt::print("{}", Fish(commands));
  });
}

}  // namespace skein
