// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "base/error.h"
#include "base/field_list.h"
#include "src/agents/low_level_option.h"
#include "src/agents/policy_file.h"
#include "src/commands/aircraft_option.h"
#include "src/commands/commands.h"
#include "src/commands/flight_options.h"
#include "src/commands/launched_ranks.h"
#include "src/commands/threads_option.h"
#include "src/config/aircraft_choice.h"
#include "src/config/conditions.h"
#include "src/config/configuration.h"
#include "src/config/key_reference.h"
#include "src/config/presets.h"
#include "src/config/settings.h"
#include "src/config/task_file.h"
#include "src/config/usage_error.h"
#include "src/config/whole_number.h"
#include "src/report/run_report.h"
#include "src/run/recorded_run.h"
#include "src/run/run_directory.h"
#include "src/run/training_run.h"
#include "train/policy/low_level_file.h"
#include "train/ppo/rank_shards.h"
#include "train/ranks/collectives.h"

namespace skein {
namespace {

struct TrainOptions {
  std::string task;
  std::string preset = "default";
  std::string config;
  std::string aircraft;
  std::vector<std::string> conditions, assignments;
  std::optional<double> steps;
  std::optional<double> seed;
  int threads = 0;
  double rank_timeout_s = kRankTimeoutS;
  std::string low_level;
  std::string from;
  std::string out;
  std::string resume;
  CLI::Option* resume_option = nullptr;
  std::string help_keys;  ///< how they are listed; empty: not
};

/// The flags that stand for one key each.
void ApplyFlags(const TrainOptions& options, ProgramConfig* config) {
  if (options.steps) Assign("run.total_steps", *options.steps, "--steps", config);
  if (options.seed) Assign("run.seed", *options.seed, "--seed", config);
}

/// What the command line asks for, for a new run.
ProgramConfig Configure(const TrainOptions& options, const std::string& task) {
  return AsUsage([&] {
    ProgramConfig config = ResolveConfig(
        {task, options.preset, options.config, options.assignments, options.conditions});
    ApplyFlags(options, &config);
    CheckConsistent(config);
    return config;
  });
}

std::string RunToResume(const TrainOptions& options) {
  if (!options.resume.empty() && options.resume != "latest") return options.resume;
  if (const auto latest = LatestRun(kRunsRoot, TaskNameOf(options.task))) return *latest;
  throw UsageError(fmt::format("nothing to resume: there is no run{} in {}/",
                               options.task.empty() ? "" : " of " + options.task, kRunsRoot));
}

/// The configuration of the run to resume, unless something else is asked for.
ProgramConfig ConfigureResumed(const TrainOptions& options, const RunDirectory& directory) {
  ProgramConfig config = RecordedConfig(directory);
  CheckConsistent(config);
  if (!options.task.empty() && TaskNameOf(options.task) != config.train.env.task) {
    throw UsageError(fmt::format("{}: is a run of task {}, not {}", directory.path(),
                                 config.train.env.task, options.task));
  }
  if (IsTaskFile(options.task) && TaskFileHash(options.task) != config.train.env.task_file_hash) {
    throw UsageError(fmt::format(
        "{}: a resumed run keeps its task file, but {} says something else now; begin a new run "
        "instead",
        directory.path(), options.task));
  }
  const ProgramConfig asked = AsUsage([&] {
    ProgramConfig changed = config;
    ApplyConditionsAndAssignments(options.conditions, options.assignments, &changed);
    ApplyFlags(options, &changed);
    return changed;
  });
  if (const auto differences = DifferencesFromRecord(config, asked); !differences.empty()) {
    throw UsageError(fmt::format(
        "{}: a resumed run keeps its configuration, but this was asked for: {}; begin a new run "
        "instead",
        directory.path(), fmt::join(differences, ", ")));
  }
  if (!options.low_level.empty()) {
    const ChosenLowLevelPolicy asked_low_level =
        ChooseLowLevelPolicy(config.train.env, options.low_level);
    if (!IsSamePolicy(asked_low_level.policy.get(), config.train.low_level.get())) {
      throw UsageError(
          fmt::format("{}: a resumed run keeps its low-level policy, but --low-level {} is "
                      "another one; begin a new run instead",
                      directory.path(), options.low_level));
    }
  }
  return config;
}

/// Returns the run's directory if it has come to its end and this process has led it, else nothing.
std::string Resume(const TrainOptions& options, Ranks& ranks) {
  std::optional<RunDirectory> directory;
  ProgramConfig config;
  DoTogether(ranks, [&] {
    const std::string run = RunToResume(options);
    directory.emplace(ranks.rank() == 0 ? RunDirectory::Open(run) : RunDirectory::Visit(run));
    config = ConfigureResumed(options, *directory);
    AsUsage([&] { return ShardsOfRank(config.train, ranks); });
  });
  WorkerPool pool(options.threads);
  if (ranks.rank() != 0) {
    FollowResumedRun(config, *directory, pool, ranks);
    return "";
  }
  const std::string path = directory->path();
  return TrainingRun::Resume(config, std::move(*directory), pool, {}, ranks) == 0 ? path : "";
}

/// Begins a new run; returns what Resume does.
std::string Begin(const TrainOptions& options, Ranks& ranks) {
  ProgramConfig config;
  RunOrigin origin;
  DoTogether(ranks, [&] {
    if (options.task.empty()) {
      throw CLI::RequiredError(fmt::format("TASK ({})", fmt::join(PresetTasks(), ", ")));
    }
    config = Configure(options, options.task);
    ChooseShards(options.assignments, ranks, &config.train);
    origin.from = options.from.empty() ? "" : NetworksFileOf(options.from);
    const ChosenLowLevelPolicy low_level =
        ChooseLowLevelPolicy(config.train.env, options.low_level, origin.from);
    config.train.low_level = low_level.policy;
    origin.low_level = low_level.description;
  });
  origin.preset = IsTaskFile(options.task) ? "of " + options.task : options.preset;
  if (!options.config.empty()) origin.preset += " and " + options.config;
  WorkerPool pool(options.threads);
  if (ranks.rank() != 0) {
    FollowRun(config, origin.from, pool, ranks);
    return "";
  }
  WarnOfTargets(config.train.env);
  std::string path;
  origin.directory = &path;
  return TrainingRun::Begin(config, options.out, pool, origin, ranks) == 0 ? path : "";
}

void Train(TrainOptions options) {
  if (!options.aircraft.empty()) {
    options.assignments.insert(options.assignments.begin(), AircraftAssignment(options.aircraft));
  }
  if (options.help_keys == "markdown") {
    fmt::print("{}", DescribeKeysMarkdown());
    return;
  }
  if (!options.help_keys.empty()) {
    if (options.help_keys != "true") {
      throw UsageError(fmt::format("--help-keys={}: give --help-keys or --help-keys=markdown",
                                   options.help_keys));
    }
    const std::string task = options.task.empty() ? EnvConfig{}.task : options.task;
    fmt::print("{}", DescribeKeys(Configure(options, task)));
    return;
  }
  std::string finished;
  OnLaunchedRanks(options.rank_timeout_s, [&](Ranks& ranks) {
    finished = options.resume_option->count() > 0 ? Resume(options, ranks) : Begin(options, ranks);
  });
  if (finished.empty()) return;
  WorkerPool pool(options.threads);
  ReportFinishedRun(finished, pool);
}

constexpr const char* kFooter =
    "From lowest to highest precedence: built-in defaults, preset, --config, --condition, "
    "--set,\n"
    "--steps and --seed. SIGINT (Ctrl-C), SIGTERM and SIGHUP drop the iteration under way, save, "
    "and end\n"
    "with exit code 0; a second one ends at once. SIGUSR1 saves after the iteration.\n"
    "Examples:\n"
    "  skein train heading\n"
    "  skein train heading --steps 5e7 --seed 2 --out runs/short\n"
    "  skein train control --set env.control.pitch_change_rad=0.9\n"
    "  skein train tracking --preset planner --low-level policies/control.skein\n"
    "  skein train heading --set ppo.learning_rate=5e-4 --set env.observation_noise=0.03\n"
    "  skein train heading --condition windy=0..120fps,calm..moderate --condition "
    "noisy=0.01..0.05\n"
    "  skein train heading --from runs/short --steps 1e8 --set ppo.learning_rate=3e-5\n"
    "  skein train my_task.toml\n"
    "  skein train heading --aircraft my.json\n"
    "  skein train --resume runs/short";

/// Who computes: threads, and other processes.
void AddWorkerOptions(CLI::App* command, TrainOptions* options) {
  AddThreadsOption(command, &options->threads);
  AddRankTimeoutOption(command, &options->rank_timeout_s);
}

}  // namespace

void AddTrainCommand(CLI::App* app) {
  auto options = std::make_shared<TrainOptions>();
  CLI::App* command = app->add_subcommand("train", "Train a policy, then evaluate it");
  command->add_option("task", options->task, TaskHelp())->type_name("TASK");
  CLI::Option* preset =
      command
          ->add_option("--preset", options->preset,
                       fmt::format("named configuration: {}; skein list presets says which task "
                                   "has which",
                                   PresetHelp()))
          ->type_name("PRESET")
          ->capture_default_str();
  CLI::Option* file = command
                          ->add_option("--config", options->config,
                                       "TOML file on top of the preset (keys: --help-keys)")
                          ->type_name("FILE");
  AddAircraftOption(command, &options->aircraft);
  command->add_option("--condition", options->conditions, ConditionHelp())
      ->type_name("NAME=LEVEL")
      ->allow_extra_args(false);
  command
      ->add_option("--set", options->assignments,
                   "one configuration key, on top of preset and file; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      ->add_option("--steps", options->steps,
                   "budget in control steps (50 Hz) over all aircraft, such as 10M or 1.35e9; same "
                   "as --set run.total_steps=...")
      ->transform(WholeNumber(1, kMostWholeNumber));
  command->add_option("--seed", options->seed, "seed of the run; same as --set run.seed=...")
      ->transform(WholeNumber(0, kMostWholeNumber));
  command
      ->add_option("--low-level", options->low_level,
                   "for presets planner and paper of task tracking: the low-level policy, trained "
                   "on task control (a file, or a "
                   "run's best), or autopilot[:VARIANT] (autopilot means autopilot:aggressive)")
      ->type_name("RUN_OR_POLICY");
  CLI::Option* out = command
                         ->add_option("--out", options->out,
                                      "directory of the run; it must not hold one already "
                                      "(default: runs/TASK-DATE-TIME)")
                         ->type_name("DIR");
  CLI::Option* from =
      command
          ->add_option("--from", options->from,
                       "start from the networks of a run (its newest checkpoint) or a policy, with "
                       "a fresh optimiser and the whole budget: to fine-tune what is finished")
          ->type_name("RUN_OR_POLICY");
  options->resume_option =
      command
          ->add_option(
              "--resume", options->resume,
              "resume the run in DIR, or the latest in runs/ (of TASK, if given), bit-exactly")
          ->type_name("[DIR|latest]")
          ->expected(0, 1)
          ->excludes(preset)
          ->excludes(file)
          ->excludes(out)
          ->excludes(from);
  AddWorkerOptions(command, options.get());
  command->add_flag("--help-keys", options->help_keys,
                    "list every configuration key with type, range, value and meaning, and exit; "
                    "--help-keys=markdown: as docs/reference/configuration.md");
  command->footer(kFooter);
  command->callback([options] { Train(*options); });
}

}  // namespace skein
