// SPDX-License-Identifier: Apache-2.0
#include "src/config/configuration.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <optional>

#include "base/error.h"
#include "envs/aircraft/registry.h"
#include "src/config/conditions.h"
#include "src/config/presets.h"
#include "src/config/settings.h"
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

void ApplyTable(const toml::table& table, const std::string& prefix, const std::string& source,
                ProgramConfig* config) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix + std::string(name.str());
    const bool is_prefix = node.is_table() && [&key] {
      for (const Setting& setting : Settings()) {
        if (setting.key.compare(0, key.size() + 1, key + ".") == 0) return true;
      }
      return false;
    }();
    if (is_prefix) {
      ApplyTable(*node.as_table(), key + ".", source, config);
      continue;
    }
    const std::string where = At(source, node);
    const Setting& setting = FindSetting(key, where);
    const std::optional<SettingValue> value = ToValue(node);
    if (!value) {
      throw Error(fmt::format("{}: {} must be {}, not a TOML {}", where, key, setting.TypeName(),
                              node.is_table()   ? "table"
                              : node.is_array() ? "array"
                                                : "date or time"));
    }
    Assign(setting, *value, where, config);
  }
}

std::string Trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// The value of an assignment: TOML if it reads as one value, else the bare text as a name.
SettingValue ParseValue(const std::string& text) {
  try {
    const toml::table table = toml::parse("value = " + text);
    if (table.size() == 1) {
      if (const auto value = ToValue(*table.get("value"))) return *value;
    }
  } catch (const toml::parse_error&) {
    // Not TOML: a name without quotes, which Assign judges.
  }
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
  const Setting& setting = FindSetting(KeyOf(assignment), source);
  Assign(setting, ParseValue(Trimmed(assignment.substr(equals + 1))), source, config);
}

}  // namespace

void ApplyToml(const std::string& text, const std::string& source, ProgramConfig* config) {
  toml::table table;
  try {
    table = toml::parse(text, source);
  } catch (const toml::parse_error& error) {
    throw Error(fmt::format("{}:{}: not valid TOML: {}", source, error.source().begin.line,
                            error.description()));
  }
  ApplyTable(table, "", source, config);
}

void ApplyTomlFile(const std::string& path, ProgramConfig* config) {
  ApplyToml(ReadFile(path), path, config);
}

std::string KeyOf(const std::string& assignment) {
  return Trimmed(assignment.substr(0, assignment.find('=')));
}

void ApplyConditionsAndAssignments(const std::vector<std::string>& conditions,
                                   const std::vector<std::string>& assignments,
                                   ProgramConfig* config) {
  for (const std::string& assignment : ConditionAssignments(conditions)) {
    ApplyAssignment(assignment, "--condition", config);
  }
  for (const std::string& assignment : assignments) {
    ApplyAssignment(assignment, "--set", config);
  }
}

void RequireTask(const ProgramConfig& config, const std::string& task) {
  if (config.train.env.task == task) return;
  throw Error(fmt::format("the configuration says env.task = {}, but the task asked for is {}",
                          config.train.env.task, task));
}

void CheckConsistent(const ProgramConfig& config) {
  Validate(config.train.env);
  LoadAircraft(config.train.env.aircraft);  // throws on an unknown name
  Validate(config.train.ppo);
  if (config.checkpoint.interval_iterations == 0 && config.checkpoint.interval_s == 0) {
    throw Error(
        "configuration: checkpoint.interval_iterations and checkpoint.interval_s are both 0; "
        "one of them must be positive");
  }
}

ProgramConfig ResolveConfig(const ConfigSources& sources) {
  ProgramConfig config;
  config.train.env.task = sources.task;
  const Preset& preset = FindPreset(sources.task, sources.preset);
  ApplyToml(std::string(*preset.text), fmt::format("preset {}/{}", preset.task, preset.name),
            &config);
  if (!sources.file.empty()) ApplyTomlFile(sources.file, &config);
  ApplyConditionsAndAssignments(sources.conditions, sources.assignments, &config);
  RequireTask(config, sources.task);
  return config;
}

std::string DumpToml(const ProgramConfig& config) {
  std::string text = "# The complete configuration of a run of skein.\n";
  std::string table;
  for (const Setting& setting : Settings()) {
    if (const std::string owner = TableOf(setting.key); owner != table) {
      table = owner;
      text += fmt::format("\n[{}]\n", table);
    }
    text += fmt::format("{} = {}  # {}\n", LastPart(setting.key), FormatValue(setting, config),
                        setting.description);
  }
  return text;
}

std::vector<std::string> Differences(const ProgramConfig& a, const ProgramConfig& b) {
  std::vector<std::string> differences;
  for (const Setting& setting : Settings()) {
    const std::string ours = FormatValue(setting, a), theirs = FormatValue(setting, b);
    if (ours != theirs) {
      differences.push_back(fmt::format("{} ({} against {})", setting.key, ours, theirs));
    }
  }
  return differences;
}

std::string DescribeKeys(const ProgramConfig& defaults) {
  std::string text;
  for (const Setting& setting : Settings()) {
    const std::string bounds = setting.BoundsText();
    text +=
        fmt::format("{} = {}\n    {}{}: {}\n", setting.key, FormatValue(setting, defaults),
                    setting.TypeName(), bounds.empty() ? "" : " in " + bounds, setting.description);
  }
  return text;
}

}  // namespace skein
