// SPDX-License-Identifier: Apache-2.0
#include "src/config/task_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

#include "base/ends_with.h"
#include "base/error.h"
#include "base/fnv_hash.h"
#include "base/nearest_name.h"
#include "envs/task_registry.h"
#include "envs/tasks/observation_layout.h"
#include "src/config/table_reader.h"
#include "src/config/task_checks.h"
#include "src/config/task_sections.h"
#include "src/config/term_numbers.h"
#include "src/files/input_text.h"
#include "src/files/plain_line.h"

namespace skein {
namespace {

constexpr std::size_t kMostBytes = 1 << 16;

void ReadName(TableReader& reader, const std::string& source, TermTaskConfig* task) {
  reader.Description("description");
  task->name = reader.Text("name", "");
  if (task->name.empty()) {
    throw Error(source + ": a task file needs a name, such as name = \"hold_bank\"");
  }
  const std::string where = source + ": name";
  RequireName(task->name, where);
  const std::vector<std::string> known = TaskNames();
  if (std::find(known.begin(), known.end(), task->name) != known.end()) {
    throw Error(
        fmt::format("{} must be another than {}, which is a built-in task", where, task->name));
  }
}

void ReadObserved(const toml::table& table, const std::string& source, TermTaskConfig* task) {
  TableReader own(table, source);
  const TermNumbers numbers(*task);
  std::set<std::string> known;
  for (const toml::node* node : own.Elements("numbers")) {
    task->observed.push_back(numbers.Read(*node, "numbers", own));
    if (!known.insert(task->observed.back().name).second) {
      throw Error(
          fmt::format("{} has {} twice", own.At(*node, "numbers"), task->observed.back().name));
    }
  }
  RequireAtMost(task->observed.size(), TermTaskConfig::kMaxNumbers, own.Here(), "numbers");
  task->observes_flight = own.Flag("flight", true);
  task->observes_actions = own.Flag("last_actions", false);
  own.RefuseOthers();
  ObservationLayout layout;
  layout.lead = static_cast<int>(task->observed.size());
  layout.flight = task->observes_flight;
  layout.actions = task->observes_actions ? kObservedActions : 0;
  if (layout.size() < kFewestObservations) {
    throw Error(fmt::format("{}: it observes {} numbers, but there must be at least {}", own.Here(),
                            layout.size(), kFewestObservations));
  }
}

/// What the tables of the task's own keys say.
TermTaskConfig ReadTerms(const toml::table& table, const std::string& source) {
  TableReader reader(table, source);
  TermTaskConfig task;
  ReadName(reader, source, &task);
  if (const toml::table* terrain = reader.Table("terrain")) ReadTerrain(*terrain, source, &task);
  for (const toml::table* target : reader.Tables("target")) ReadTarget(*target, source, &task);
  RequireAtMost(task.targets.size(), TermTaskConfig::kMaxTargets, source, "targets");
  const toml::table* const observed = reader.Table("observe");
  if (observed == nullptr) throw Error(source + ": a task file needs [observe]");
  ReadObserved(*observed, source, &task);
  for (const toml::table* reward : reader.Tables("reward")) ReadReward(*reward, source, &task);
  RequireAtMost(task.rewards.size(), TermTaskConfig::kMaxRewards, source, "rewards");
  if (const toml::table* reached = reader.Table("reached")) ReadReached(*reached, source, &task);
  for (const toml::table* end : reader.Tables("termination")) ReadEnd(*end, source, &task);
  RequireAtMost(task.ends.size(), TermTaskConfig::kMaxConditions, source, "terminations");
  return task;
}

/// All that gives a row of observations its meaning.
std::string InterfaceOf(const TermTaskConfig& task) {
  const auto unit = [](const TermUnit& of) {
    return fmt::format("{}*{}", static_cast<int>(of.reference), of.number);
  };
  std::string text =
      fmt::format("{} {} {}", task.name, task.observes_flight, task.observes_actions);
  for (const TermNumber& number : task.observed) {
    const bool is_error = number.value == TermValue::kTargetError;
    const std::string of =
        is_error ? task.targets[static_cast<std::size_t>(number.target)].quantity.name : "";
    text += fmt::format(" {} {} {}", number.name, of, unit(number.unit));
  }
  return HexHash(text);
}

const std::vector<std::string>& TaskKeys() {
  static const std::vector<std::string> keys = {"name",   "description", "observe", "target",
                                                "reward", "reached",     "terrain", "termination"};
  return keys;
}

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

bool IsTaskFile(const std::string& task) { return EndsWith(task, ".toml"); }

std::string ReadTaskFileText(const std::string& path) {
  std::string text = ReadInputText(path);
  if (text.size() <= kMostBytes) return text;
  throw Error(
      fmt::format("{}: a task file has at most {} bytes, not {}", path, kMostBytes, text.size()));
}

namespace {

TaskFile ReadTables(const std::string& text, const std::string& source,
                    const std::vector<std::string>& settings_tables) {
  if (text.size() > kMostBytes) {
    throw Error(fmt::format("{}: a task file has at most {} bytes", source, kMostBytes));
  }
  toml::table table = ParseToml(text, source);
  TaskFile file;
  for (auto&& [name, node] : table) {
    const std::string key(name.str());
    if (Contains(TaskKeys(), key)) continue;
    if (!Contains(settings_tables, key)) {
      std::vector<std::string> known = TaskKeys();
      known.insert(known.end(), settings_tables.begin(), settings_tables.end());
      throw Error(fmt::format("{}:{}: unknown key {}{}; known keys: {}", source,
                              node.source().begin.line, key, DidYouMean(key, known),
                              fmt::join(known, ", ")));
    }
    file.settings.insert(key, std::move(node));  // a copy forgets its line
  }
  file.terms = ReadTerms(table, source);
  file.terms.text = text;
  file.terms.hash = HexHash(text);
  file.terms.interface = InterfaceOf(file.terms);
  return file;
}

}  // namespace

TaskFile ReadTaskFile(const std::string& text, const std::string& source,
                      const std::vector<std::string>& settings_tables) {
  try {
    return ReadTables(text, source, settings_tables);
  } catch (const Error& error) {
    throw Error(PlainLine(error.what()));
  }
}

}  // namespace skein
