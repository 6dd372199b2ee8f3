// SPDX-License-Identifier: Apache-2.0
#include "src/commands/wrong_usage.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <sstream>
#include <system_error>

#include "base/ends_with.h"
#include "base/field_list.h"
#include "base/nearest_name.h"
#include "src/commands/command_tree.h"
#include "src/config/other_names.h"
#include "src/config/program_config.h"
#include "src/config/settings.h"
#include "src/files/plain_line.h"

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

bool Takes(const CLI::App& command, const char* option) {
  const std::vector<std::string> options = OptionNames(command);
  return std::count(options.begin(), options.end(), option) > 0;
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

/// How the command is told the setting: by an option of its own, or by --set.
std::string OptionOf(const CLI::App& command, const std::string& key) {
  if (key == "run.total_steps" && Takes(command, "--steps")) return "--steps";
  std::string option = "--" + key.substr(key.rfind('.') + 1);
  std::replace(option.begin(), option.end(), '_', '-');
  return Takes(command, option.c_str()) ? option : "--set " + key + "=VALUE";
}

/// "; did you mean --set ppo.gamma=VALUE?" for an option that is called as a key is, here or in
/// other PPO implementations; empty if none is.
std::string KeyMeant(const CLI::App& command, const std::string& option) {
  if (!Takes(command, "--set")) return "";
  ProgramConfig config;
  std::vector<Field> fields = FieldsOf(config);
  fields.erase(std::remove_if(fields.begin(), fields.end(),
                              [&command](const Field& field) { return !Heeds(command, field); }),
               fields.end());
  MeantSetting meant = FindMeantSetting(fields, option);
  if (!meant.name.empty()) meant.name = OptionOf(command, meant.name);
  return DidYouMean(meant);
}

/// "; did you mean --action-repeat?" for --action_repeat, and --altitude-ft for --altitude; empty
/// if the command has no such option.
std::string OtherwiseWritten(const CLI::App& command, const std::string& option) {
  const std::string written = WrittenAsKey(option);
  for (const std::string& own : OptionNames(command)) {
    const std::string own_written = WrittenAsKey(own);
    if (own_written == written || own_written.rfind(written + "_", 0) == 0) {
      return "; did you mean " + own + "?";
    }
  }
  return "";
}

/// Whether the command takes `option`, "--task", as an argument without a name.
bool TakesWithoutName(const CLI::App& command, const std::string& option) {
  const std::vector<const CLI::Option*> options = command.get_options();
  return std::any_of(options.begin(), options.end(), [&option](const CLI::Option* argument) {
    return argument->get_positional() && "--" + argument->get_name(true) == option;
  });
}

bool IsOneOf(const std::string& name, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), WrittenAsKey(name)) != names.end();
}

/// What stands here for options of other training programs; empty if nothing is known of `name`.
std::string OptionElsewhere(const CLI::App& command, const std::string& name) {
  if (IsOneOf(name, {"device", "gpu", "gpus", "cuda"})) {
    return "; Skein computes on the CPU, with --threads threads";
  }
  if (IsOneOf(name, {"env", "env_id", "env_name"}) && TakesWithoutName(command, "--task")) {
    return "; the task is written alone, without " + name;
  }
  if (IsOneOf(name, {"exp_name", "experiment_name", "run_name", "name", "log_dir", "logdir",
                     "output_dir", "save_dir", "save_path"}) &&
      Takes(command, "--out")) {
    return "; did you mean --out?";
  }
  const bool is_policy = IsOneOf(name, {"model", "model_path", "checkpoint", "checkpoint_path",
                                        "ckpt", "load", "load_run", "load_path", "weights"});
  if (is_policy && Takes(command, "--policy")) return "; did you mean --policy?";
  if (is_policy && Takes(command, "--resume")) {
    return "; --resume goes on with a run, and --from starts from a policy";
  }
  if (IsOneOf(name, {"wandb", "wandb_project", "wandb_project_name", "track", "tensorboard",
                     "tensorboard_log"}) &&
      command.get_name() == "train") {
    return "; every run writes TensorBoard's events and metrics.csv";
  }
  return "";
}

/// What was meant by an option that the command does not have: of two commands that fly policies,
/// one is told of a policy and the other of agents. Empty if nothing is near.
std::string OptionMeant(const CLI::App& command, const std::string& name) {
  if (name == "--controller") return "; it is now called --low-level";
  if (name == "--policy" && Takes(command, "--agents")) {
    return "; did you mean --agents policy:FILE_OR_RUN?";
  }
  if (name == "--agents" && Takes(command, "--policy")) {
    return "; it flies one --policy, and skein compare several agents";
  }
  if (TakesWithoutName(command, name)) return "; its value is written alone, without " + name;
  for (const auto& find : {OptionElsewhere, OtherwiseWritten, KeyMeant}) {
    std::string meant = find(command, name);
    if (!meant.empty()) return meant;
  }
  return DidYouMean(name, OptionNames(command));
}

std::string UnknownOption(const CLI::App& command, const std::string& argument) {
  const std::string name = argument.substr(0, argument.find('='));
  return fmt::format("unknown option {}{}", PlainLine(argument), OptionMeant(command, name));
}

/// What was meant by an argument of a command that takes no more: a policy with the option that
/// takes it, the value of --set KEY VALUE, or KEY=VALUE without --set. Empty if nothing is near.
std::string ArgumentMeant(const CLI::App& command, const std::string& argument) {
  std::error_code failure;
  if (EndsWith(argument, ".skein") || std::filesystem::is_directory(argument, failure)) {
    const char* const option = Takes(command, "--policy")   ? "--policy "
                               : Takes(command, "--agents") ? "--agents policy:"
                                                            : "";
    return *option == '\0' ? "" : fmt::format("; did you mean {}{}?", option, argument);
  }
  if (!Takes(command, "--set")) return "";
  if (const std::size_t equals = argument.find('='); equals != std::string::npos) {
    return OptionMeant(command, "--" + argument.substr(0, equals));
  }
  for (const std::string& assignment : command.get_option("--set")->results()) {
    if (assignment.find('=') != std::string::npos) continue;
    return fmt::format("; did you mean --set {}={}?", assignment, argument);
  }
  return "";
}

/// An argument of a command that takes no more; it is the value of an option that an option before
/// it took for its own: --preset --threads 1.
std::string Unexpected(const CLI::App& command, const std::string& argument) {
  for (const CLI::Option* option : GivenOptions(command)) {
    for (const std::string& value : option->results()) {
      if (Takes(command, value.c_str())) return NameOf(*option) + " needs a value";
    }
  }
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
  return unknown.empty() ? WrongOptions(command, error) : Unexpected(command, unknown.front());
}

}  // namespace

std::string WrongUsage(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& deepest = DeepestOf(program);
  // What stands before the command is left with the program, which has hardly an option itself.
  for (const std::string& argument : program.remaining()) {
    if (&deepest == &program || argument.rfind('-', 0) != 0) continue;
    const std::string name = argument.substr(0, argument.find('='));
    const std::string wrong = Takes(deepest, name.c_str()) ? name + " is written behind the command"
                                                           : UnknownOption(deepest, argument);
    return fmt::format("{} (see {} --help)", wrong, CommandPath(program));
  }
  return fmt::format("{} (see {} --help)", WhatIsWrong(deepest, error), CommandPath(program));
}

}  // namespace skein
