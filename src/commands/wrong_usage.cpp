// SPDX-License-Identifier: Apache-2.0
#include "src/commands/wrong_usage.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>
#include <utility>

#include "base/ends_with.h"
#include "base/field_list.h"
#include "base/nearest_name.h"
#include "src/commands/command_tree.h"
#include "src/commands/words_of_others.h"
#include "src/config/conditions.h"
#include "src/config/other_names.h"
#include "src/config/presets.h"
#include "src/config/program_config.h"
#include "src/config/settings.h"
#include "src/files/plain_line.h"
#include "src/files/shell_text.h"
#include "src/run/run_directory.h"

namespace skein {
namespace {

/// The deepest subcommand that the command line reached.
const CLI::App& DeepestOf(const CLI::App& program) {
  const CLI::App* deepest = &program;
  while (!deepest->get_subcommands().empty()) deepest = deepest->get_subcommands().front();
  return *deepest;
}

/// As "skein fdm eval".
std::string CommandPath(const CLI::App& app) {
  std::string path = app.get_name();
  for (const CLI::App* sub : app.get_subcommands()) path += " " + CommandPath(*sub);
  return path;
}

std::vector<const CLI::Option*> GivenOptions(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) { return option->count() > 0; });
}

/// "--policy", or of an argument without dashes what it stands for, "FILE".
std::string NameOf(const CLI::Option& option) {
  if (option.nonpositional()) return option.get_name();
  const std::string type = option.get_type_name();
  return type.substr(0, type.find(':'));
}

/// Two options that were given and exclude each other.
std::string Excluded(const CLI::App& command) {
  for (const CLI::Option* option : GivenOptions(command)) {
    for (const CLI::Option* other : option->get_excludes()) {
      if (other->count() == 0) continue;
      return fmt::format("{} and {} exclude each other", option->get_name(), other->get_name());
    }
  }
  return "two of the options exclude each other";
}

/// An option that was given without another one, which it is for.
std::string Lonely(const CLI::App& command) {
  for (const CLI::Option* option : GivenOptions(command)) {
    for (const CLI::Option* other : option->get_needs()) {
      if (other->count() > 0) continue;
      return fmt::format("{} needs {}", option->get_name(), other->get_name());
    }
  }
  return "an option needs another one";
}

/// What of a command is required and was not given; `otherwise` if nothing is.
std::string Missing(const CLI::App& command, const std::string& otherwise) {
  if (!CommandsOf(command).empty()) {
    std::vector<std::string> names;
    for (const CLI::App* below : CommandsOf(command)) names.push_back(below->get_name());
    return fmt::format("a command is needed: {}", fmt::join(names, ", "));
  }
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_required() && option->count() == 0) return NameOf(*option) + " is required";
  }
  return otherwise;
}

/// The option that a text of CLI11 is about: its first word that begins with a dash.
std::string OptionIn(const std::string& text) {
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (word.front() == '-') return word.substr(0, word.find_first_of(":,="));
  }
  return "an argument";
}

/// Too few or too many values.
std::string Mismatch(const std::string& text) {
  const bool is_missing = text.find("missing") != std::string::npos;
  return OptionIn(text) + (is_missing ? " needs a value" : " has more values than it takes");
}

/// What is wrong with the options of a command, all of which are known.
std::string WrongOptions(const CLI::App& command, const CLI::ParseError& error) {
  const std::string kind = error.get_name();
  std::string text = error.what();
  if (kind == "ExcludesError") return Excluded(command);
  if (kind == "RequiresError") return Lonely(command);
  if (kind == "RequiredError") return Missing(command, text);
  if (kind == "ArgumentMismatch") return Mismatch(text);
  if (kind == "ConversionError") return OptionIn(text) + " does not take such a value";
  return text;  // a ValidationError, whose words are the program's own
}

/// The task that was given, as an argument or by --task; empty if none was.
std::string TaskOf(const CLI::App& command) {
  for (const char* name : {"task", "--task"}) {
    const CLI::Option* const option = command.get_option_no_throw(name);
    if (option != nullptr && option->count() > 0) return option->results().front();
  }
  return "";
}

/// Trainings heed all keys, and so do benchmarks; what flies heeds keys of flights. Keys
/// env.task... are for the program to set.
bool Heeds(const CLI::App& command, const Field& field) {
  if (field.key.rfind("env.task", 0) == 0) return false;
  const std::string task = TaskOf(command);
  if (!field.tasks.empty() && !task.empty() && !field.IsOf(task)) return false;
  if (command.get_name() == "train" || command.get_parent()->get_name() == "bench") return true;
  return field.key.rfind("env.", 0) == 0 && !field.is_training_only;
}

/// How the command is told the setting: by an option of its own, or by --set; without a `value` it
/// is VALUE.
std::string OptionOf(const CLI::App& command, const std::string& key, const std::string& value) {
  if (key == "run.total_steps" && HasOption(command, "--steps")) return "--steps";
  std::string option = "--" + key.substr(key.rfind('.') + 1);
  std::replace(option.begin(), option.end(), '_', '-');
  if (HasOption(command, option)) return option;
  return fmt::format("--set {}={}", key, value.empty() ? "VALUE" : ShellWord(PlainLine(value)));
}

/// "; did you mean --set ppo.gamma=0.9?" for an option that is called as a key is, here or in other
/// PPO implementations; empty if none is.
std::string KeyMeant(const CLI::App& command, const std::string& option, const std::string& value) {
  if (!HasOption(command, "--set")) return "";
  ProgramConfig config;
  std::vector<Field> fields = FieldsOf(config);
  fields.erase(std::remove_if(fields.begin(), fields.end(),
                              [&command](const Field& field) { return !Heeds(command, field); }),
               fields.end());
  MeantSetting meant = FindMeantSetting(fields, option);
  if (meant.name.empty()) return "";
  // A value that means something else elsewhere is not repeated.
  meant.name = OptionOf(command, meant.name, meant.difference.empty() ? value : "");
  return DidYouMean(meant);
}

/// "; did you mean --condition windy=hard?" for --windy and windy; empty if that is no condition.
std::string ConditionMeant(const CLI::App& command, const std::string& option,
                           const std::string& value) {
  if (!HasOption(command, "--condition")) return "";
  for (const ConditionForm& condition : ConditionForms()) {
    if (WrittenAsKey(option) != condition.name) continue;
    return fmt::format("; did you mean --condition {}={}?", condition.name,
                       value.empty() ? "LEVEL" : ShellWord(PlainLine(value)));
  }
  return "";
}

/// "; did you mean --action-repeat?" for --action_repeat, and --altitude-ft for --altitude; empty
/// if the command has no such option.
std::string OtherwiseWritten(const CLI::App& command, const std::string& option) {
  for (const std::string& own : OptionNames(command)) {
    if (WrittenAsKey(own) == WrittenAsKey(option) || IsInUnitOf(own, option)) {
      return DidYouMeanOption(option, own);
    }
  }
  return "";
}

std::string WithoutDashes(const std::string& option) {
  return option.substr(std::min(option.find_first_not_of('-'), option.size()));
}

/// "; did you mean --steps?" for --stpes; dashes are no letters that agree. Empty if none is near.
std::string NearestOption(const CLI::App& command, const std::string& option) {
  std::vector<std::string> names;
  for (const std::string& own : OptionNames(command)) names.push_back(WithoutDashes(own));
  const std::string nearest = NearestName(WithoutDashes(option), names);
  return nearest.empty() ? "" : DidYouMeanOption(option, "--" + nearest);
}

/// Whether the command takes `option`, "--task", as an argument without a name.
bool TakesWithoutName(const CLI::App& command, const std::string& option) {
  const CLI::Option* const argument = command.get_option_no_throw(WithoutDashes(option));
  return argument != nullptr && argument->get_positional();
}

/// What was meant by an option that the command does not have, and by its value if that is known.
/// Empty if nothing is near.
std::string OptionMeant(const CLI::App& command, const std::string& name,
                        const std::string& value) {
  for (const std::string& meant :
       {OptionMeantElsewhere(command, name), OtherwiseWritten(command, name),
        ConditionMeant(command, name, value), KeyMeant(command, name, value)}) {
    if (!meant.empty()) return meant;
  }
  return NearestOption(command, name);
}

/// `text` in what stands before the first '=', and what behind it.
std::pair<std::string, std::string> SplitAssignment(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return {text, ""};
  return {text.substr(0, equals), text.substr(equals + 1)};
}

std::string UnknownOption(const CLI::App& command, const std::string& argument) {
  const auto [name, value] = SplitAssignment(argument);
  const std::string meant = TakesWithoutName(command, name)
                                ? "; its value is written alone, without " + name
                                : OptionMeant(command, name, value);
  return fmt::format("unknown option {}{}", PlainLine(argument), meant);
}

/// "; did you mean --policy a.skein?" for the policy or run `argument`; empty if the command takes
/// none.
std::string PolicyOption(const CLI::App& command, const std::string& argument) {
  const std::string word = ShellWord(PlainLine(argument));
  if (HasOption(command, "--policy")) return fmt::format("; did you mean --policy {}?", word);
  if (HasOption(command, "--agents")) {
    return fmt::format("; did you mean --agents policy:{}?", word);
  }
  return HasOption(command, "--from") ? fmt::format("; did you mean --from {}?", word) : "";
}

/// What was meant by an argument of a command that takes no more: a policy or a task with the
/// option that takes it, KEY=VALUE without --set, or the value of --set KEY VALUE. Empty if nothing
/// is near.
std::string ArgumentMeant(const CLI::App& command, const std::string& argument) {
  if (EndsWith(argument, ".skein") || IsRunDirectory(argument)) {
    return PolicyOption(command, argument);
  }
  const std::vector<std::string> tasks = PresetTasks();
  if (HasOption(command, "--task") && std::count(tasks.begin(), tasks.end(), argument) > 0) {
    return fmt::format("; did you mean --task {}?", argument);
  }
  if (const auto [name, value] = SplitAssignment(argument); !value.empty()) {
    return OptionMeant(command, "--" + name, value);
  }
  for (const auto& [option, meant] :
       {std::pair("--set", &KeyMeant), std::pair("--condition", &ConditionMeant)}) {
    if (!HasOption(command, option)) continue;
    for (const std::string& assignment : command.get_option(option)->results()) {
      if (assignment.find('=') == std::string::npos) return meant(command, assignment, "");
    }
  }
  return "";
}

std::string Unexpected(const CLI::App& command, const std::string& argument) {
  return fmt::format("unexpected argument {}{}", PlainLine(argument),
                     ArgumentMeant(command, argument));
}

/// Names that are not known come first, in their order: CLI11 says that what is required is missing
/// where it was misspelt. Of a command that is not known, the options cannot be.
std::string WhatIsWrong(const CLI::App& command, const CLI::ParseError& error) {
  const std::vector<std::string> unknown = command.remaining();
  const bool has_commands = !CommandsOf(command).empty();
  if (has_commands && !unknown.empty() && unknown.front().rfind('-', 0) != 0) {
    return UnknownCommand(command, unknown.front());
  }
  for (const std::string& argument : unknown) {
    if (argument.rfind('-', 0) != 0) continue;
    return UnknownOption(command, argument);
  }
  // A value that is no value explains what is left over: --out --threads 2.
  const bool is_of_options = unknown.empty() || error.get_name() == "ValidationError";
  return is_of_options ? WrongOptions(command, error) : Unexpected(command, unknown.front());
}

}  // namespace

std::string WrongUsage(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& deepest = DeepestOf(program);
  // What stands before the command is left with the program, which has hardly an option itself.
  for (const std::string& argument : program.remaining()) {
    if (&deepest == &program || argument.rfind('-', 0) != 0) continue;
    const std::string name = SplitAssignment(argument).first;
    const std::string wrong = HasOption(deepest, name) ? name + " is written behind the command"
                                                       : UnknownOption(deepest, argument);
    return fmt::format("{} (see {} --help)", wrong, CommandPath(program));
  }
  return fmt::format("{} (see {} --help)", WhatIsWrong(deepest, error), CommandPath(program));
}

}  // namespace skein
