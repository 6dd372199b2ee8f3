// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cctype>
#include <sstream>
#include <string>
#include <vector>

#include "src/bench/version.h"
#include "src/commands/command_forms.h"
#include "src/commands/commands.h"

namespace skein {
namespace {

/// `text` as roff prints it: backslashes and hyphens escaped, no line taken for a request.
std::string Escaped(const std::string& text) {
  std::string escaped;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else {
      escaped += c;
    }
    at_start = c == '\n';
  }
  return escaped;
}

/// Prose, escaped, in lines of up to kLineLength characters where it has spaces to break at.
std::string Prose(const std::string& text) {
  constexpr std::size_t kLineLength = 80;
  std::string lines, line;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string next = Escaped(line.empty() ? word : " " + word);
    if (line.size() + next.size() > kLineLength) {
      lines += line + "\n";
      line = Escaped(word);
    } else {
      line += next;
    }
  }
  return lines + line;
}

std::string Upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string OptionEntry(const OptionForm& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.names) {
    names.push_back("\\fB" + Escaped(option.is_argument ? Upper(name) : name) + "\\fR");
  }
  const std::string value =
      option.is_argument || option.value.empty() ? "" : " \\fI" + Escaped(option.value) + "\\fR";
  std::string description = option.description;
  const bool says_choices = option.choices.empty() || option.value.find('=') != std::string::npos ||
                            option.description.find(option.choices.front()) != std::string::npos;
  if (!says_choices) {
    description += fmt::format(" (one of {})", fmt::join(option.choices, ", "));
  }
  return fmt::format(".TP\n{}{}\n{}\n", fmt::join(names, ", "), value, Prose(description));
}

std::string Synopsis(const CommandForm& command) {
  std::string line = "\\fB" + Escaped(command.path) + "\\fR [\\fIOPTIONS\\fR]";
  for (const OptionForm& option : command.options) {
    if (option.is_argument) line += " \\fI" + Escaped(option.value) + "\\fR";
  }
  if (!command.commands.empty()) line += " \\fICOMMAND\\fR";
  return line + "\n";
}

std::string Section(const CommandForm& command) {
  std::string text = fmt::format(".SS {}\n{}.PP\n{}.\n", Escaped(command.path), Synopsis(command),
                                 Prose(command.app->get_description()));
  for (const OptionForm& option : command.options) text += OptionEntry(option);
  if (const std::string footer = command.app->get_footer(); !footer.empty()) {
    text += fmt::format(".PP\n.nf\n{}\n.fi\n", Escaped(footer));
  }
  return text;
}

/// A manual page in the man macros of roff, section 1.
std::string ManualPage(const std::vector<CommandForm>& commands) {
  const CommandForm& program = commands.front();
  std::string text = fmt::format(
      ".TH SKEIN 1 \"{}\" \"skein {}\" \"User Commands\"\n"
      ".SH NAME\nskein \\- {}\n"
      ".SH SYNOPSIS\n{}"
      ".SH OPTIONS\n",
      Build().date, Build().version, Escaped(program.app->get_description()), Synopsis(program));
  for (const OptionForm& option : program.options) text += OptionEntry(option);
  text += ".SH COMMANDS\n";
  for (std::size_t i = 1; i < commands.size(); ++i) text += Section(commands[i]);
  text += fmt::format(".SH EXAMPLES\n.nf\n{}\n.fi\n", Escaped(program.app->get_footer()));
  return text +
         ".SH EXIT STATUS\n"
         "0 on success, 1 on failure, 2 on wrong usage.\n"
         "An error is one line on the standard error.\n"
         ".SH ENVIRONMENT\n"
         ".TP\n\\fBSKEIN_SIMD\\fR\n"
         "forces a SIMD target: avx512, avx2, sse4, neon or scalar\n"
         ".TP\n\\fBCC\\fR\n"
         "the C compiler of skein export \\-\\-check (default: cc)\n"
         ".TP\n\\fBSKEIN_PYTHON\\fR\n"
         "the Python of skein export \\-\\-check (default: python3)\n"
         ".TP\n\\fBNO_COLOR\\fR\n"
         "if set, progress is shown without colour\n"
         ".SH FILES\n"
         "What is called docs/, configs/studies/ or examples/ lies in the source tree,\n"
         "and of an installation in share/doc/skein.\n"
         "Policies of an installation lie in share/skein/policies.\n";
}

}  // namespace

void AddManualCommand(CLI::App* app) {
  CLI::App* command = app->add_subcommand("man", "Print the manual page, of all commands");
  command->footer("Example: skein man | man -l -");
  command->callback([app] { fmt::print("{}", ManualPage(CommandForms(*app))); });
}

}  // namespace skein
