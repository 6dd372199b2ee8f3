// SPDX-License-Identifier: Apache-2.0
#include "src/study/study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "base/error.h"
#include "base/field_list.h"
#include "base/nearest_name.h"
#include "envs/task_registry.h"
#include "src/config/aircraft_choice.h"
#include "src/config/conditions.h"
#include "src/config/configuration.h"
#include "src/config/settings.h"
#include "src/config/table_reader.h"
#include "src/config/usage_error.h"
#include "src/evaluation/comparison.h"
#include "src/files/output_file.h"
#include "src/files/text_table.h"

namespace skein {
namespace {

template <typename T>
void RefuseEmptyAndTwice(const std::vector<T>& values, const std::string& source,
                         const std::string& key) {
  if (values.empty()) throw Error(fmt::format("{}: {} must name at least one", source, key));
  std::set<T> known;
  for (const T& value : values) {
    if (!known.insert(value).second) {
      throw Error(fmt::format("{}: {} names {} twice", source, key, value));
    }
  }
}

constexpr double kMaxEpisodes = 1e7;

StudySettings ReadSettings(TableReader& reader) {
  return {reader.Texts("condition"), reader.Texts("set")};
}

StudyLevel ReadLevel(const toml::table& table, const std::string& source) {
  TableReader reader(table, source);
  StudyLevel level;
  level.name = reader.Text("name", "");
  level.settings = ReadSettings(reader);
  reader.RefuseOthers();
  if (level.name.empty()) {
    throw Error(fmt::format("{}:{}: a level needs a name", source, table.source().begin.line));
  }
  return level;
}

Study ReadTable(const toml::table& table, const std::string& source) {
  TableReader reader(table, source);
  Study study;
  study.tasks = reader.Texts("tasks");
  study.seeds = reader.WholeNumbers("seeds", kMostWholeNumber);
  study.agents = reader.Texts("agents");
  study.preset = reader.Text("preset", study.preset);
  reader.RefuseOld("controller", "low_level");
  study.low_level = reader.Text("low_level", "");
  study.aircraft = reader.Text("aircraft", "");
  study.assignments = reader.Texts("set");
  if (const toml::table* training = reader.Table("training")) {
    TableReader part(*training, source);
    study.training.steps = part.WholeNumber("steps", 1, kMostWholeNumber);
    study.training.from = part.Texts("from");
    study.training.settings = ReadSettings(part);
    study.training.per_level = part.Flag("per_level", true);
    part.RefuseOthers();
  }
  if (const toml::table* evaluation = reader.Table("evaluation")) {
    TableReader part(*evaluation, source);
    study.evaluation.episodes = static_cast<int>(
        part.WholeNumber("episodes", 1, kMaxEpisodes).value_or(study.evaluation.episodes));
    study.evaluation.seed =
        static_cast<std::uint64_t>(part.WholeNumber("seed", 0, kMostWholeNumber).value_or(0));
    study.evaluation.hold_s = part.PositiveNumber("hold");
    study.evaluation.mission_min = part.PositiveNumber("mission");
    part.RefuseOthers();
  }
  for (const toml::table* level : reader.Tables("level")) {
    study.levels.push_back(ReadLevel(*level, source));
  }
  reader.RefuseOthers();
  if (study.levels.empty()) study.levels.push_back({"default", {}});
  study.all_levels = study.levels;
  return study;
}

/// The levels called `names`, in the file's order.
std::vector<StudyLevel> ChosenLevels(const std::vector<StudyLevel>& levels,
                                     const std::vector<std::string>& names,
                                     const std::string& source) {
  std::vector<std::string> known;
  for (const StudyLevel& level : levels) known.push_back(level.name);
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw Error(fmt::format("{}: no level is called {}{}; levels: {}", source, name,
                            DidYouMean(name, known), fmt::join(known, ", ")));
  }
  std::vector<StudyLevel> chosen;
  std::copy_if(levels.begin(), levels.end(), std::back_inserter(chosen),
               [&names](const StudyLevel& level) {
                 return std::find(names.begin(), names.end(), level.name) != names.end();
               });
  return chosen;
}

void Choose(const StudyChoice& choice, const std::string& source, Study* study) {
  if (!choice.levels.empty()) study->levels = ChosenLevels(study->levels, choice.levels, source);
  if (!choice.seeds.empty()) study->seeds = choice.seeds;
  if (choice.steps) study->training.steps = choice.steps;
  if (!choice.aircraft.empty()) study->aircraft = choice.aircraft;
}

/// Throws Error on what the study would not follow.
void RefuseWithoutEffect(const Study& study, const std::string& source) {
  const std::size_t origins = study.training.from.size();
  if (origins != 0 && origins != study.tasks.size()) {
    throw Error(fmt::format("{}: from names {} for {}: one for each task, or none", source, origins,
                            Counted(static_cast<int>(study.tasks.size()), "task")));
  }
  for (const std::string& origin : study.training.from) {
    if (origin.empty()) throw Error(source + ": from names a run or a policy, not \"\"");
  }
  std::vector<std::string> assignments = study.assignments;
  const auto append = [&assignments](const StudySettings& settings) {
    assignments.insert(assignments.end(), settings.assignments.begin(), settings.assignments.end());
  };
  append(study.training.settings);
  for (const StudyLevel& level : study.levels) append(level.settings);
  for (const std::string& assignment : assignments) {
    if (KeyOf(assignment) == "env.aircraft" && !study.aircraft.empty()) {
      throw Error(fmt::format("{}: set {}: aircraft says it already", source, assignment));
    }
    if (KeyOf(assignment) == "run.seed") {
      throw Error(fmt::format("{}: set {}: seeds says the seeds", source, assignment));
    }
    if (KeyOf(assignment) == "run.total_steps" && study.training.steps) {
      throw Error(fmt::format("{}: set {}: training.steps says it already", source, assignment));
    }
  }
  if (study.training.per_level) return;
  std::vector<std::string> said_by_evaluation;
  for (const std::string& assignment :
       FlightLengthAssignments(study.evaluation.hold_s, study.evaluation.mission_min)) {
    said_by_evaluation.push_back(KeyOf(assignment));
  }
  for (const StudyLevel& level : study.levels) {
    for (const std::string& assignment : level.settings.assignments) {
      const std::string key = KeyOf(assignment);
      if (std::count(said_by_evaluation.begin(), said_by_evaluation.end(), key) != 0) {
        throw Error(fmt::format("{}: set {} of level {}: evaluation.{} says it already", source,
                                assignment, level.name,
                                study.evaluation.mission_min ? "mission" : "hold"));
      }
      if (key.rfind("env.", 0) == 0) continue;
      throw Error(
          fmt::format("{}: set {} of level {}: nothing is trained for it (per_level is "
                      "false), and its evaluation has keys of env alone",
                      source, assignment, level.name));
    }
  }
}

/// The assignments without those that mean something to other tasks of the study alone.
std::vector<std::string> AssignmentsFor(const std::string& task, const Study& study,
                                        const std::vector<std::string>& assignments) {
  ProgramConfig any;
  const std::vector<Field> fields = FieldsOf(any);
  const auto is_for_another = [&](const std::string& assignment) {
    return std::any_of(fields.begin(), fields.end(), [&](const Field& field) {
      return field.key == KeyOf(assignment) && !field.IsOf(task) &&
             std::any_of(study.tasks.begin(), study.tasks.end(),
                         [&field](const std::string& other) { return field.IsOf(other); });
    });
  };
  std::vector<std::string> own = assignments;
  own.erase(std::remove_if(own.begin(), own.end(), is_for_another), own.end());
  return own;
}

/// The study's preset and assignments, then `parts`, each of higher precedence than those before.
ProgramConfig Configure(const Study& study, const std::string& task,
                        const std::vector<StudySettings>& parts) {
  return AsUsage([&] {
    std::vector<std::string> assignments = AssignmentsFor(task, study, study.assignments);
    if (!study.aircraft.empty()) {
      assignments.insert(assignments.begin(), AircraftAssignment(study.aircraft));
    }
    const ProgramConfig base = ResolveConfig({task, study.preset, "", assignments});
    std::vector<std::string> conditions;
    for (const StudySettings& part : parts) {
      conditions.insert(conditions.end(), part.conditions.begin(), part.conditions.end());
    }
    ConditionAssignments(conditions);  // refuses one that two parts give
    ProgramConfig config = WithAircraft(base, [&](ProgramConfig* changed) {
      for (const StudySettings& part : parts) {
        ApplyConditionsAndAssignments(part.conditions,
                                      AssignmentsFor(task, study, part.assignments), changed);
      }
    });
    RequireTask(config.train.env, base.train.env);
    RequireOwnScale(base, config);
    return config;
  });
}

}  // namespace

Study ReadStudy(const std::string& path, const StudyChoice& choice) {
  const toml::table table = ParseToml(ReadFile(path), path);
  Study study = ReadTable(table, path);
  Choose(choice, path, &study);
  RefuseEmptyAndTwice(study.tasks, path, "tasks");
  RefuseEmptyAndTwice(study.seeds, choice.seeds.empty() ? path : "--seeds", "seeds");
  if (!study.agents.empty()) RefuseEmptyAndTwice(study.agents, path, "agents");
  std::vector<std::string> files;
  for (const StudyLevel& level : study.all_levels) files.push_back(FileNamePart(level.name));
  RefuseEmptyAndTwice(files, path, "level");
  RefuseWithoutEffect(study, path);
  return study;
}

ProgramConfig TrainingConfig(const Study& study, const std::string& task, const StudyLevel& level,
                             std::uint64_t seed) {
  std::vector<StudySettings> parts = {study.training.settings};
  if (study.training.per_level) parts.push_back(level.settings);
  ProgramConfig config = Configure(study, task, parts);
  AsUsage([&] { CheckConsistent(config); });
  if (study.training.steps) {
    Assign("run.total_steps", *study.training.steps, "steps", &config);
  }
  config.train.seed = seed;
  return config;
}

ProgramConfig LevelConfig(const Study& study, const std::string& task, const StudyLevel& level) {
  const bool can_hold = !MakeTask(Configure(study, task, {}).train.env)->is_point();
  const StudySettings flights = {
      {},
      FlightLengthAssignments(can_hold ? study.evaluation.hold_s : std::nullopt,
                              study.evaluation.mission_min)};
  ProgramConfig config = Configure(study, task, {level.settings, flights});
  AsUsage([&] { CheckFlyable(config.train.env); });
  if (!study.training.per_level) {
    const EnvConfig without_level = Configure(study, task, {}).train.env;
    AsUsage([&] { CheckEachAgentsOwn(config.train.env, without_level); });
  }
  return config;
}

}  // namespace skein
