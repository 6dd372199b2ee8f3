// SPDX-License-Identifier: Apache-2.0
#include "src/config/configuration.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/trimmed.h"
#include "envs/aircraft/registry.h"
#include "src/config/aircraft_choice.h"
#include "src/config/conditions.h"
#include "src/config/presets.h"
#include "src/config/settings.h"
#include "src/config/table_reader.h"
#include "src/config/task_file.h"
#include "src/config/whole_number.h"
#include "src/files/input_text.h"
#include "src/files/output_file.h"

namespace skein {
namespace {

std::optional<SettingValue> ToValue(const toml::node& node) {
  if (const auto* flag = node.as_boolean()) return SettingValue(flag->get());
  if (const auto* integer = node.as_integer()) return SettingValue(integer->get());
  if (const auto* number = node.as_floating_point()) return SettingValue(number->get());
  if (const auto* text = node.as_string()) return SettingValue(text->get());
  return std::nullopt;
}

std::string At(const std::string& source, const toml::node& node) {
  return fmt::format("{}:{}", source, node.source().begin.line);
}

/// How a TOML text is read.
enum class Reading {
  kStrict,  ///< of users and presets: all that is said must count
  kRecord,  ///< a run's own, perhaps by an older version: keys of other tasks, and former names
};

/// Throws Error if the field means nothing to the task that is flown.
void RequireOfTask(const Field& field, const std::string& task, const std::string& where) {
  if (field.IsOf(task)) return;
  throw Error(fmt::format("{}: {} is of task {} and means nothing to task {}", where, field.key,
                          fmt::join(field.tasks, ", "), task));
}

bool IsTableOf(const std::string& table, const std::string& key) {
  return key.compare(0, table.size() + 1, table + ".") == 0;
}

/// Applies a TOML document to a configuration.
class TomlReader {
 public:
  TomlReader(std::string source, Reading reading, ProgramConfig* config)
      : source_(std::move(source)),
        reading_(reading),
        config_(*config),
        fields_(FieldsOf(*config)) {}

  void Apply(const toml::table& table, const std::string& prefix) {
    for (const auto& [name, node] : table) {
      const std::string key = prefix + std::string(name.str());
      if (node.is_table() && IsTable(key)) {
        Apply(*node.as_table(), key + ".");
      } else {
        ApplyValue(key, node);
      }
    }
  }

 private:
  bool IsTable(const std::string& name) const {
    return std::any_of(fields_.begin(), fields_.end(), [&name](const Field& field) {
      return IsTableOf(name, field.key) || IsTableOf(name, field.former_key);
    });
  }

  const Field& Find(const std::string& key, const std::string& where) const {
    if (reading_ == Reading::kRecord) {
      for (const Field& field : fields_) {
        if (field.former_key == key) return field;
      }
    }
    return FindField(fields_, key, where);
  }

  void ApplyValue(const std::string& key, const toml::node& node) {
    const std::string where = At(source_, node);
    const Field& field = Find(key, where);
    const auto [first, is_first] = lines_.emplace(field.key, node.source().begin.line);
    if (!is_first) {  // once as the quoted key "a.b", once as b in [a]
      throw Error(fmt::format("{}: {} is given in line {}, too", where, field.key, first->second));
    }
    const std::optional<SettingValue> value = ToValue(node);
    if (!value) {
      throw Error(fmt::format("{}: {} must be {}, not a TOML {}", where, field.key,
                              field.TypeName(),
                              node.is_table()   ? "table"
                              : node.is_array() ? "array"
                                                : "date or time"));
    }
    if (reading_ == Reading::kStrict) RequireOfTask(field, config_.train.env.task, where);
    Assign(field, *value, where);
  }

  std::string source_;
  Reading reading_;
  const ProgramConfig& config_;
  std::vector<Field> fields_;
  std::map<std::string, toml::source_index> lines_;  ///< of the keys that have been read
};

void ApplyText(const std::string& text, const std::string& source, Reading reading,
               ProgramConfig* config) {
  TomlReader(source, reading, config).Apply(ParseToml(text, source), "");
}

ProgramConfig ConfigOf(const Preset& preset) {
  ProgramConfig base;
  base.train.env.task = preset.task;
  return WithAircraft(base, [&preset](ProgramConfig* config) {
    ApplyText(std::string(*preset.text), fmt::format("preset {}/{}", preset.task, preset.name),
              Reading::kStrict, config);
  });
}

ProgramConfig TaskFileDefaults() {
  return WithAircraft(ProgramConfig(), [](ProgramConfig* config) {
    ApplyText(std::string(TaskFileSettings()), "settings of task files", Reading::kStrict, config);
  });
}

/// The tables that configuration keys are in: "env", "ppo" and so on.
const std::vector<std::string>& SettingsTables() {
  static const std::vector<std::string> tables = [] {
    ProgramConfig any;
    std::vector<std::string> names;
    for (const Field& field : FieldsOf(any)) {
      std::string name = field.key.substr(0, field.key.find('.'));
      if (names.empty() || names.back() != name) names.push_back(std::move(name));
    }
    return names;
  }();
  return tables;
}

/// Of a path without one: where the program runs.
std::string FolderOf(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

/// The path of an aircraft's file in the text of a task file that a policy holds is from a folder
/// that is not known any more: `aircraft` stands for it, if that is known.
void FindAircraftOfText(const std::string& aircraft, toml::table* settings) {
  toml::table* const env = settings->get_as<toml::table>("env");
  const auto* const named = env == nullptr ? nullptr : env->get_as<std::string>("aircraft");
  if (named == nullptr || !IsAircraftPath(named->get())) return;
  if (aircraft.empty()) {
    env->erase("aircraft");
  } else {
    env->insert_or_assign("aircraft", aircraft);
  }
}

ProgramConfig ConfigOfTaskFile(const ConfigSources& sources) {
  if (sources.preset != "default") {
    throw Error(
        fmt::format("preset {}: presets are of built-in tasks; a task file brings its own "
                    "settings, and --config "
                    "others",
                    sources.preset));
  }
  const std::string text =
      sources.task_text.empty() ? ReadTaskFileText(sources.task) : sources.task_text;
  TaskFile file = ReadTaskFile(text, sources.task, SettingsTables());
  if (!sources.task_text.empty()) FindAircraftOfText(sources.text_aircraft, &file.settings);
  ProgramConfig base = TaskFileDefaults();
  base.train.env.SetTermTask(file.terms);
  const std::string folder = sources.task_text.empty() ? FolderOf(sources.task) : "";
  return WithAircraft(base, [&](ProgramConfig* config) {
    TomlReader(sources.task, Reading::kStrict, config).Apply(file.settings, "");
    RequireTask(config->train.env, base.train.env, sources.task);
    KeepAircraft(folder, &config->train.env);
  });
}

/// Gives a configuration that a run has recorded the task file that it names.
void RecallTaskFile(const std::string& path, ProgramConfig* config) {
  EnvConfig& env = config->train.env;
  if (env.task_file_hash.empty()) return;
  const std::string beside = (std::filesystem::path(path).parent_path() / kTaskFileOfRun).string();
  const TermTaskConfig terms =
      ReadTaskFile(ReadTaskFileText(beside), beside, SettingsTables()).terms;
  if (terms.hash != env.task_file_hash) {
    throw Error(fmt::format("{}: is not the task file that {} was made with (hash {}, not {})",
                            beside, path, terms.hash, env.task_file_hash));
  }
  env.term_task = std::make_shared<const TermTaskConfig>(terms);
}

/// The value if the text reads as one of TOML.
std::optional<SettingValue> TomlValue(const std::string& text) {
  try {
    const toml::table table = toml::parse("value = " + text);
    if (table.size() == 1) return ToValue(*table.get("value"));
  } catch (const toml::parse_error&) {
    // A suffix, or a name without quotes, which Assign judges.
  }
  return std::nullopt;
}

/// What an assignment says behind its equals sign, `equals`.
std::string ValueTextOf(const std::string& assignment, std::size_t equals) {
  return Trimmed(assignment.substr(equals + 1));
}

/// The value of an assignment: TOML if it reads as one value; for a number with a suffix (10M) that
/// number; else the bare text as a name.
SettingValue ParseValue(const std::string& text, const Field& field) {
  if (const auto value = TomlValue(text)) return *value;
  if (const auto number = ReadNumber(text); number && field.IsNumber()) return *number;
  return text;
}

std::string TableOf(const std::string& key) { return key.substr(0, key.rfind('.')); }
std::string LastPart(const std::string& key) { return key.substr(key.rfind('.') + 1); }

/// Applies one `key=value` of `source`. The value is TOML; names need no quotes.
void ApplyAssignment(const std::string& assignment, const std::string& source,
                     ProgramConfig* config) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos) {
    throw Error(fmt::format("{} {}: expected key=value", source, assignment));
  }
  const std::vector<Field> fields = FieldsOf(*config);
  const std::string key = KeyOf(assignment);
  const Field& field = FindField(fields, key, source);
  RequireOfTask(field, config->train.env.task, source);
  Assign(field, ParseValue(ValueTextOf(assignment, equals), field), source);
}

}  // namespace

void ApplyToml(const std::string& text, const std::string& source, ProgramConfig* config) {
  ApplyText(text, source, Reading::kStrict, config);
}

void ApplyTomlFile(const std::string& path, ProgramConfig* config) {
  ApplyToml(ReadInputText(path), path, config);
  KeepAircraft(FolderOf(path), &config->train.env);
}

ProgramConfig ReadRecord(const std::string& path) {
  ProgramConfig config;
  ApplyText(ReadFile(path), path, Reading::kRecord, &config);
  RecallTaskFile(path, &config);
  KeepAircraft(FolderOf(path), &config.train.env);
  return config;
}

std::vector<std::string> FlightLengthAssignments(std::optional<double> hold_s,
                                                 std::optional<double> mission_min) {
  constexpr double kSecondsPerMinute = 60;
  std::vector<std::string> assignments;
  if (hold_s) assignments.push_back(fmt::format("env.hold_s={}", *hold_s));
  if (mission_min) {
    assignments.push_back(fmt::format("env.mission.length_s={}", *mission_min * kSecondsPerMinute));
    // Whatever a preset holds: a mission's targets come one after another.
    if (*mission_min > 0 && !hold_s) assignments.push_back("env.hold_s=0");
  }
  return assignments;
}

std::string KeyOf(const std::string& assignment) {
  return Trimmed(assignment.substr(0, assignment.find('=')));
}

std::string NameAssigned(const std::string& assignment, const std::string& key) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || KeyOf(assignment) != key) return "";
  const std::string text = ValueTextOf(assignment, equals);
  const std::optional<SettingValue> value = TomlValue(text);
  const auto* const quoted = value ? std::get_if<std::string>(&*value) : nullptr;
  return quoted != nullptr ? *quoted : text;
}

void ApplyConditionsAndAssignments(const std::vector<std::string>& conditions,
                                   const std::vector<std::string>& assignments,
                                   ProgramConfig* config, const std::string& source) {
  for (const std::string& assignment : ConditionAssignments(conditions)) {
    ApplyAssignment(assignment, "--condition", config);
  }
  for (const std::string& assignment : assignments) {
    ApplyAssignment(assignment, source, config);
  }
  KeepAircraft("", &config->train.env);
}

void RequireTask(const EnvConfig& env, const EnvConfig& asked, const std::string& source) {
  if (env.task != asked.task) {
    throw Error(fmt::format("{} says env.task = {}, but the task asked for is {}", source, env.task,
                            asked.task));
  }
  const auto require = [&source](const char* key, const std::string& said, const std::string& is) {
    if (said == is) return;
    throw Error(fmt::format("{} is of another task file: it says {} = \"{}\", not \"{}\"", source,
                            key, said, is));
  };
  require("env.task_file_hash", env.task_file_hash, asked.task_file_hash);
  require("env.task_interface", env.task_interface, asked.task_interface);
}

void CheckConsistent(const ProgramConfig& config) {
  Validate(config.train.env);
  LoadAircraft(config.train.env.aircraft);  // throws on an unknown name
  ValidateLearning(config.train);
  if (config.checkpoint.interval_iterations == 0 && config.checkpoint.interval_s == 0) {
    throw Error(
        "configuration: checkpoint.interval_iterations and checkpoint.interval_s are both 0; "
        "one of them must be positive");
  }
}

void CheckFlyable(const EnvConfig& env) {
  Validate(EvaluationConfig(env));
  LoadAircraft(env.aircraft);  // throws on an unknown name
}

std::string AircraftFileNamedIn(const std::string& path) {
  const toml::table table = ParseToml(ReadInputText(path), path);
  const auto named = table["env"]["aircraft"].value<std::string>();
  if (!named || !IsAircraftPath(*named)) return "";
  return (std::filesystem::path(FolderOf(path)) / *named).string();
}

std::string TaskNameOf(const std::string& task) {
  if (!IsTaskFile(task)) return task;
  return ReadTaskFile(ReadTaskFileText(task), task, SettingsTables()).terms.name;
}

TermTaskConfig TermTaskIn(const std::string& text, const std::string& source) {
  return ReadTaskFile(text, source, SettingsTables()).terms;
}

std::string TaskFileHash(const std::string& path) {
  return ReadTaskFile(ReadTaskFileText(path), path, SettingsTables()).terms.hash;
}

ProgramConfig ResolveConfig(const ConfigSources& sources) {
  const bool is_file = !sources.task_text.empty() || IsTaskFile(sources.task);
  const ProgramConfig base =
      is_file ? ConfigOfTaskFile(sources) : ConfigOf(FindPreset(sources.task, sources.preset));
  ProgramConfig config = WithAircraft(base, [&](ProgramConfig* changed) {
    if (!sources.file.empty()) ApplyTomlFile(sources.file, changed);
    ApplyConditionsAndAssignments(sources.conditions, sources.assignments, changed,
                                  sources.assignments_are);
    RequireTask(changed->train.env, base.train.env);
  });
  RequireOwnScale(base, config);
  const bool is_of_base = config.train.env.aircraft == base.train.env.aircraft;
  if (is_of_base && !sources.is_beginning) RequireScaleOfTaskFile(config);
  return config;
}

void RequireScaleOfTaskFile(const ProgramConfig& config) {
  if (config.train.env.term_task != nullptr) RequireOwnScale(TaskFileDefaults(), config);
}

std::string DumpToml(const ProgramConfig& config) {
  std::string text = "# The complete configuration of a run of skein.\n";
  std::string table;
  ProgramConfig listed = config;
  for (const Field& field : FieldsOf(listed)) {
    if (!field.IsOf(config.train.env.task)) continue;
    if (const std::string owner = TableOf(field.key); owner != table) {
      table = owner;
      text += fmt::format("\n[{}]\n", table);
    }
    text += fmt::format("{} = {}  # {}\n", LastPart(field.key), TomlText(field), field.help);
  }
  return text;
}

std::vector<std::string> Differences(const ProgramConfig& a, const ProgramConfig& b) {
  ProgramConfig ours = a, theirs = b;
  const std::vector<Field> our_fields = FieldsOf(ours), their_fields = FieldsOf(theirs);
  std::vector<std::string> differences;
  for (std::size_t i = 0; i < our_fields.size(); ++i) {
    if (!our_fields[i].IsOf(a.train.env.task) && !our_fields[i].IsOf(b.train.env.task)) continue;
    const std::string our = TomlText(our_fields[i]), their = TomlText(their_fields[i]);
    if (our == their) continue;
    differences.push_back(fmt::format("{} ({} against {})", our_fields[i].key, our, their));
  }
  return differences;
}

}  // namespace skein
