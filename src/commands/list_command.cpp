// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "envs/aircraft/registry.h"
#include "envs/task_registry.h"
#include "src/agents/agent_names.h"
#include "src/agents/policy_file.h"
#include "src/commands/commands.h"
#include "src/config/conditions.h"
#include "src/config/configuration.h"
#include "src/config/one_of.h"
#include "src/config/presets.h"
#include "src/files/installed_file.h"
#include "src/files/text_table.h"
#include "src/run/progress.h"
#include "src/run/run_summary.h"
#include "train/policy/policy_parameters.h"

namespace skein {
namespace {

using Row = std::vector<std::string>;
using Rows = std::vector<Row>;

Rows Tasks() {
  Rows rows = {{"task", "target", "flown by"}};
  for (const std::string& name : TaskNames()) {
    EnvConfig config;
    config.task = name;
    std::vector<std::string> targets;
    for (const TargetQuantity& target : MakeTask(config)->target_quantities()) {
      targets.emplace_back(target.column);
    }
    rows.push_back({name, fmt::format("{}", fmt::join(targets, ", ")),
                    CanBeHierarchical(name)
                        ? "one policy, or a high-level policy over a low-level policy"
                        : "one policy"});
  }
  return rows;
}

Rows PresetRows() {
  Rows rows = {{"task", "--preset", "control steps", "is"}};
  for (const Preset& preset : Presets()) {
    const ProgramConfig config = ResolveConfig({preset.task, preset.name, "", {}});
    rows.push_back({preset.task, preset.name,
                    FormatCount(static_cast<double>(config.train.total_steps)),
                    PresetMeaning(preset.name)});
  }
  return rows;
}

Rows Conditions() {
  Rows rows = {{"condition", "mild", "middle", "hard"}};
  for (const ConditionForm& form : ConditionForms()) {
    rows.push_back({form.name, form.mild, form.middle, form.hard});
  }
  for (const ConditionForm& form : ConditionForms()) {
    rows.push_back({fmt::format("{}: {}", form.name, form.level)});
  }
  return rows;
}

Rows AircraftRows() {
  Rows rows = {{"aircraft", "mass, lb", "span, ft"}};
  for (const std::string& name : AircraftNames()) {
    const Airframe airframe = LoadAircraft(name).airframe;
    rows.push_back({name, fmt::format("{:.1f}", airframe.mass_slug * kGravityFtS2),
                    fmt::format("{:.1f}", airframe.span_ft)});
  }
  return rows;
}

Rows Agents() {
  Rows rows = {{"agent", "what flies"}};
  for (const AgentForm& form : AgentForms()) rows.push_back({form.name, form.meaning});
  return rows;
}

Row PolicyRow(const std::string& path) {
  try {
    const auto policy = LoadPolicy(TensorFile::Read(PolicyFileOf(path)), path);
    const auto aircraft = policy->environment.find("aircraft");
    return {path, policy->task.empty() ? "unknown" : policy->task,
            aircraft == policy->environment.end() ? "unknown" : aircraft->second,
            fmt::format("{} control steps", policy->action_repeat)};
  } catch (const Error& error) {
    return {path, error.what()};
  }
}

Rows Policies() {
  std::set<std::string> paths;
  for (const std::string& folder : {std::string(kPoliciesRoot), InstalledFile(kPoliciesRoot)}) {
    std::error_code absent;
    for (const auto& entry : std::filesystem::directory_iterator(folder, absent)) {
      if (entry.path().extension() != ".skein") continue;
      paths.insert(kPoliciesRoot + entry.path().filename().string());
    }
  }
  Rows rows = {{"policy", "task", "aircraft", "holds an action for"}};
  for (const std::string& path : paths) rows.push_back(PolicyRow(path));
  if (paths.empty()) rows.push_back({fmt::format("(none in {} here)", kPoliciesRoot)});
  return rows;
}

Rows Runs() {
  Rows rows = {{"run", "task", "aircraft", "control steps", "success", "state"}};
  for (const RunSummary& run : SummariseRuns(kRunsRoot)) {
    rows.push_back({run.path, run.task, run.aircraft, run.steps, run.success, run.state});
  }
  if (rows.size() == 1) rows.push_back({fmt::format("(none in {}/ here)", kRunsRoot)});
  return rows;
}

struct Listing {
  const char* name;
  Rows (*rows)();
};
constexpr Listing kListings[] = {
    {"tasks", Tasks},       {"presets", PresetRows}, {"conditions", Conditions},
    {"policies", Policies}, {"runs", Runs},          {"aircraft", AircraftRows},
    {"agents", Agents}};

void Print(const std::string& what) {
  bool first = true;
  for (const Listing& listing : kListings) {
    if (!what.empty() && what != listing.name) continue;
    if (!first) fmt::print("\n");
    first = false;
    fmt::print("{}", InColumns(listing.rows()));
  }
}

}  // namespace

void AddListCommand(CLI::App* app) {
  auto what = std::make_shared<std::string>();
  CLI::App* command = app->add_subcommand(
      "list", "List tasks, presets, conditions, policies, runs, aircraft and agents");
  std::vector<std::string> names;
  for (const Listing& listing : kListings) names.emplace_back(listing.name);
  command->add_option("what", *what, "what to list (default: all)")
      ->type_name("WHAT")
      ->check(OneOf(names));
  command->footer(
      "Policies are those of the folder policies/, runs those of runs/, both of the working "
      "directory, and the policies that were installed with the program.\n"
      "Example: skein list conditions");
  command->callback([what] { Print(*what); });
}

}  // namespace skein
