// SPDX-License-Identifier: Apache-2.0
#include "src/run/training_run.h"

#include <fmt/format.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/field_list.h"
#include "base/seconds_since.h"
#include "envs/aircraft/registry.h"
#include "simd/target.h"
#include "src/bench/machine.h"
#include "src/config/conditions.h"
#include "src/config/configuration.h"
#include "src/files/output_file.h"
#include "src/files/shell_text.h"
#include "src/files/text_table.h"
#include "src/run/hyperparameters.h"
#include "src/run/progress.h"
#include "src/run/recorded_run.h"
#include "train/files/tensor_file.h"
#include "train/policy/low_level_file.h"
#include "train/policy/policy_parameters.h"
#include "train/ranks/collectives.h"

namespace skein {
namespace {

using Clock = std::chrono::steady_clock;

/// Far from the seeds that people choose for training, so that the final episodes are fresh; one
/// that --seed takes.
std::uint64_t FinalSeed(const TrainConfig& config) {
  constexpr auto kSeeds = static_cast<std::uint64_t>(kMostWholeNumber) + 1;
  return (config.seed + 1000000007) % kSeeds;
}

double UnixTime() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// By all aircraft together.
std::uint64_t ControlStepsPerIteration(const TrainConfig& config) {
  return static_cast<std::uint64_t>(config.ppo.num_aircraft) *
         static_cast<std::uint64_t>(config.ppo.rollout_steps) *
         static_cast<std::uint64_t>(config.env.action_repeat);
}

/// The budget in whole iterations.
std::uint64_t LastStep(const TrainConfig& config) {
  const std::uint64_t iteration = ControlStepsPerIteration(config);
  return (config.total_steps + iteration - 1) / iteration * iteration;
}

bool IsDamaged(const std::string& path) {
  try {
    TensorFile::Read(path);
    return false;
  } catch (const Error&) {
    return true;
  }
}

std::string CannotRestore(const Checkpoint& newest, const std::vector<Checkpoint>& all,
                          const char* reason) {
  std::string message = fmt::format("cannot resume: {}", reason);
  if (message.find(newest.path) == std::string::npos) message += " (" + newest.path + ")";
  if (all.size() > 1 && IsDamaged(newest.path)) {
    message += fmt::format("; remove that file to resume from {}", all[all.size() - 2].path);
  }
  return message;
}

/// Restores the newest checkpoint, if there is one.
CheckpointOrigin RestoreNewest(const std::vector<Checkpoint>& checkpoints, Trainer& trainer) {
  if (checkpoints.empty()) return {Name(simd::ActiveTarget()), ""};
  try {
    return trainer.Restore(checkpoints.back().path);
  } catch (const Error& error) {
    throw Error(CannotRestore(checkpoints.back(), checkpoints, error.what()));
  }
}

/// Takes over the networks of the file `from`, and says so; nothing if it is empty.
std::string StartNetworks(const std::string& from, Trainer& trainer) {
  if (from.empty()) return "";
  const bool with_critic = trainer.StartFrom(from);
  return fmt::format("started from {} ({})", from,
                     with_critic ? "actor and critic" : "actor; a fresh critic");
}

/// On all ranks together: the final evaluation of rank 0's `policy`, of which other ranks give any
/// policy of the same training.
EvaluationReport EvaluateAtEnd(RecurrentPolicy policy, const ProgramConfig& config,
                               WorkerPool& pool, Ranks& ranks) {
  return DoForOthers(ranks, [&] {
    std::vector<int> episodes = {config.final_evaluation_episodes};
    if (ranks.count() > 1) {
      ShareRankZeros(ranks, episodes);  // no part of what ranks must train alike with
      // Other ranks may not see the run's directory.
      RecurrentPolicy::Parameters parameters = *policy.parameters();
      ShareRankZeros(ranks, parameters.values);
      policy =
          RecurrentPolicy(std::make_shared<RecurrentPolicy::Parameters>(std::move(parameters)));
    }
    return EvaluateBothWays(policy.WithBackend(config.train.learner.backend), config.train.env,
                            episodes[0], FinalSeed(config.train), pool, ranks);
  });
}

/// The part of a rank that does not lead, once it has its trainer.
void Follow(ProgramConfig config, Trainer& trainer, WorkerPool& pool, Ranks& ranks) {
  config.train = trainer.config();
  DescribeRanks(config.train, pool, ranks);
  FollowLeader(trainer, pool, ranks, [&] { EvaluateAtEnd(trainer.policy(), config, pool, ranks); });
}

}  // namespace

int TrainingRun::Begin(const ProgramConfig& config, const std::string& path, WorkerPool& pool,
                       const RunOrigin& origin, Ranks& ranks) {
  const Clock::time_point start = Clock::now();
  // Before the directory, so that a configuration that cannot be trained leaves nothing behind.
  std::string started_from;
  const std::unique_ptr<Trainer> trainer =
      MakeTrainer(config.train, pool, ranks,
                  [&](Trainer& made) { started_from = StartNetworks(origin.from, made); });
  const std::string description = DescribeRanks(config.train, pool, ranks);
  RankLeader leader(ranks);
  RunDirectory directory = path.empty() ? RunDirectory::CreateIn(kRunsRoot, config.train.env.task)
                                        : RunDirectory::Create(path);
  if (origin.directory != nullptr) *origin.directory = directory.path();
  ProgramConfig resolved = config;
  resolved.train = trainer->config();
  if (config.train.low_level != nullptr) {
    TensorFile low_level;
    StoreLowLevelPolicy(*config.train.low_level, low_level);
    low_level.Write(directory.low_level());
  }
  if (const auto& terms = resolved.train.env.term_task; terms != nullptr) {
    WriteFile(directory.task_file(), terms->text);
  }
  if (const std::string& aircraft = resolved.train.env.aircraft; IsKeptFile(aircraft)) {
    WriteFile(directory.aircraft(), AircraftText(aircraft));
  }
  // A run that is killed before its first checkpoint would begin anew with fresh networks.
  if (!origin.from.empty()) {
    const std::string beginning = directory.checkpoint(0);
    leader.Say(RankCommand::kSave);
    trainer->Save(beginning);
  }
  // Last: it makes the directory one of a run.
  WriteFile(directory.config(), StartComment(started_from, origin.from) + DumpToml(resolved));
  TrainingRun run(resolved, std::move(directory), *trainer, pool, leader, description, start,
                  origin.watch);
  run.SayBanner();
  for (const std::string& line :
       {origin.preset.empty() ? "" : "preset " + origin.preset, started_from, origin.low_level}) {
    if (!line.empty()) run.log_.Say("  " + line);
  }
  return run.Run();
}

int TrainingRun::Resume(const ProgramConfig& config, RunDirectory directory, WorkerPool& pool,
                        RunWatch watch, Ranks& ranks) {
  const Clock::time_point start = Clock::now();
  CheckpointOrigin origin;
  const std::unique_ptr<Trainer> made = MakeTrainer(config.train, pool, ranks, [&](Trainer& begun) {
    directory.RemoveTemporaries();
    const std::vector<Checkpoint> checkpoints = directory.Checkpoints();
    if (checkpoints.empty() && std::filesystem::exists(directory.final_policy())) {
      throw Error(fmt::format("cannot resume: {} has been trained to its end and has no checkpoint",
                              directory.path()));
    }
    origin = RestoreNewest(checkpoints, begun);
  });
  Trainer& trainer = *made;
  const std::string description = DescribeRanks(config.train, pool, ranks);
  RankLeader leader(ranks);
  const bool is_whole = origin.records.empty() || BeginsAs(directory.metrics(), origin.records);
  const std::uint64_t rows = TrimRows(directory.metrics(), trainer.iteration(), MetricsHeader());
  TrimRows(directory.timing(), trainer.iteration(), TimingHeader());
  TrainingRun run(config, std::move(directory), trainer, pool, leader, description, start,
                  std::move(watch));
  run.SayBanner();
  if (!is_whole) {
    run.log_.Say(
        fmt::format("warning: metrics.csv is not what this run wrote in its first {} iterations: "
                    "it was damaged or edited since; the training itself is not touched by that",
                    trainer.iteration()));
  } else if (rows != trainer.iteration()) {
    run.log_.Say(fmt::format("warning: metrics.csv has {} rows for {} iterations", rows,
                             trainer.iteration()));
  }
  if (const std::string target = Name(simd::ActiveTarget()); origin.simd_target != target) {
    run.log_.Say(
        fmt::format("warning: saved with SIMD target {0}, resuming with {1}: no longer bit-exact "
                    "(SKEIN_SIMD={0} forces it)",
                    origin.simd_target, target));
  }
  return run.Run();
}

TrainingRun::TrainingRun(const ProgramConfig& config, RunDirectory directory, Trainer& trainer,
                         WorkerPool& pool, RankLeader& leader, std::string ranks,
                         Clock::time_point begun, RunWatch watch)
    : config_(config),
      directory_(std::move(directory)),
      trainer_(trainer),
      pool_(pool),
      leader_(leader),
      ranks_(std::move(ranks)),
      signals_(pool),
      log_(directory_.log(), watch.prints),
      metrics_(directory_.metrics(), MetricsHeader()),
      timing_(directory_.timing(), TimingHeader()),
      events_(directory_.path(), UnixTime(), static_cast<std::int64_t>(trainer.env_steps()) + 1),
      goes_on_(std::move(watch.goes_on)),
      last_save_(Clock::now()),
      turn_begin_(begun),
      saved_iteration_(trainer.iteration()) {
  events_.AppendSummary(UnixTime(), static_cast<std::int64_t>(trainer.env_steps()),
                        EncodeHyperparameters(DumpToml(config), directory_.path(), UnixTime()));
}

int TrainingRun::Run() {
  try {
    TrainAndEvaluate();
    return signals_.StopSignal();
  } catch (const Error& error) {
    try {
      log_.Note(fmt::format("error: {}", error.what()));
    } catch (const Error&) {  // it may be the disk that is full
    }
    throw;
  }
}

void TrainingRun::SayBanner() {
  const TrainConfig& train = config_.train;
  const std::uint64_t first_step = trainer_.env_steps();
  const bool is_rounded = LastStep(train) != train.total_steps;
  const std::string asked =
      is_rounded
          ? fmt::format(" ({} asked for)", FormatCount(static_cast<double>(train.total_steps)))
          : "";
  log_.Say(
      fmt::format("{} {} in {}\n"
                  "  {} of {} control steps{}, {} aircraft, seed {}\n"
                  "{}\n"
                  "  {}\n"
                  "  {}",
                  first_step == 0 ? "training" : "resuming", train.env.task, directory_.path(),
                  FormatCount(static_cast<double>(first_step)),
                  FormatCount(static_cast<double>(LastStep(train))), asked, train.ppo.num_aircraft,
                  train.seed, InLines("  ", DescribeConditions(train.env)),
                  Describe(trainer_.backend()), DescribeWorkers(pool_)));
  if (!ranks_.empty()) log_.Say(ranks_);
}

void TrainingRun::TrainAndEvaluate() {
  const std::uint64_t first_step = trainer_.env_steps();
  const Clock::time_point start = Clock::now();
  ProgressMeter meter(first_step, LastStep(config_.train), config_.train.env, start);
  turn_.start = SecondsSince(turn_begin_);
  std::string dropped;
  while (!trainer_.finished() && !pool_.stopping()) {
    const IterationReport report = Iterate();
    if (report.dropped) {
      dropped = fmt::format("; dropped the iteration that was under way and its {} steps",
                            FormatCount(static_cast<double>(report.dropped_steps)));
      break;
    }
    Record(report);
    meter.Add(report, Clock::now());
    log_.Show(meter.progress());
    if (goes_on_ && !goes_on_(report)) pool_.RequestStop();
    if (signals_.TakeSaveRequest()) {
      SaveCheckpoint();
      log_.Say(fmt::format("saved {} as asked", directory_.checkpoint(trainer_.iteration())));
    } else if (CheckpointIsDue()) {
      SaveCheckpoint();
    }
  }
  if (saved_iteration_ != trainer_.iteration()) SaveCheckpoint();
  directory_.Prune(config_.checkpoint.keep);  // an earlier process may have failed just before it
  log_.Note(FormatProgress(meter.progress()));
  if (!trainer_.finished()) {
    SayStopped(dropped);
    return;
  }
  log_.Say(fmt::format("trained for {} steps in {}",
                       FormatCount(static_cast<double>(trainer_.env_steps() - first_step)),
                       FormatDuration(SecondsSince(start))));
  Finish();
}

void TrainingRun::SayStopped(const std::string& dropped) {
  leader_.Say(RankCommand::kNone, signals_);  // to learn which rank's signal it was
  const int signal = signals_.StopSignal();
  log_.Say(fmt::format("stopped by {} after {} of {} steps{}; resume with: {} train --resume {}",
                       signal != 0 ? fmt::format("SIG{}", sigabbrev_np(signal)) : "its caller",
                       FormatCount(static_cast<double>(trainer_.env_steps())),
                       FormatCount(static_cast<double>(LastStep(config_.train))), dropped,
                       ProgramWord(), ShellWord(directory_.path())));
}

IterationReport TrainingRun::Iterate() {
  leader_.Say(RankCommand::kIterate, signals_);
  try {
    return trainer_.Iterate();
  } catch (const Error& error) {
    // Not named like a checkpoint: a run that resumed it would fail again.
    const std::string path = fmt::format("{}/before-failure-{:06}.skein", directory_.checkpoints(),
                                         trainer_.iteration());
    try {
      Save(path);
    } catch (const Error& failure) {
      throw Error(fmt::format("{}; the state from before could not be saved: {}", error.what(),
                              failure.what()));
    }
    throw Error(fmt::format("{}; the state from before is in {}", error.what(), path));
  }
}

void TrainingRun::Record(const IterationReport& report) {
  const double now = UnixTime();
  turn_.whole = SecondsSince(turn_begin_);
  turn_begin_ = Clock::now();
  metrics_.Append(MetricsRow(report));
  timing_.Append(TimingRow(report, now, turn_));
  events_.Append(now, static_cast<std::int64_t>(report.env_steps),
                 Scalars(report, static_cast<double>(ControlStepsPerIteration(config_.train))));
  if (report.non_finite > 0) {
    log_.Say(
        fmt::format("warning: {} aircraft, or their rewards, left the finite numbers in iteration "
                    "{} and were reset",
                    report.non_finite, report.iteration));
  }
  if (report.evaluation_success_rate >= 0) {
    log_.Note(fmt::format("iteration {}, {} steps: deterministic success {:.1f} %{}",
                          report.iteration, FormatCount(static_cast<double>(report.env_steps)),
                          100 * report.evaluation_success_rate,
                          report.best ? ", kept as the best" : ""));
  }
  if (report.best) trainer_.policy().Save(directory_.best_policy());
  turn_ = {};
  turn_.files = SecondsSince(turn_begin_);
}

bool TrainingRun::CheckpointIsDue() const {
  const CheckpointConfig& config = config_.checkpoint;
  if (config.interval_iterations > 0 &&
      trainer_.iteration() % static_cast<std::uint64_t>(config.interval_iterations) == 0) {
    return true;
  }
  return config.interval_s > 0 && SecondsSince(last_save_) >= config.interval_s;
}

void TrainingRun::Save(const std::string& path) {
  const std::string records = metrics_.Mark();
  leader_.Say(RankCommand::kSave, signals_);
  trainer_.Save(path, records);
}

void TrainingRun::SaveCheckpoint() {
  const Clock::time_point start = Clock::now();
  // Rows first: a checkpoint must never be newer than the records that it continues.
  metrics_.Sync();
  timing_.Sync();
  Save(directory_.checkpoint(trainer_.iteration()));
  saved_iteration_ = trainer_.iteration();
  last_save_ = Clock::now();
  directory_.Prune(config_.checkpoint.keep);
  turn_.files += SecondsSince(start);
}

void TrainingRun::Finish() {
  trainer_.policy().Save(directory_.final_policy());
  const bool has_best = std::filesystem::exists(directory_.best_policy());
  const std::string path = has_best ? directory_.best_policy() : directory_.final_policy();
  const RecurrentPolicy policy = RecurrentPolicy::Load(path);
  const std::uint64_t seed = FinalSeed(config_.train);
  const int episodes = config_.final_evaluation_episodes;
  log_.Say(fmt::format("evaluating {} over {}", path, Counted(episodes, "fresh episode")));
  leader_.Say(RankCommand::kEvaluate, signals_);
  const EvaluationReport report = EvaluateAtEnd(policy, config_, pool_, leader_.ranks());
  if (pool_.stopping()) {
    SayStopped("; dropped the evaluation that was under way");
    return;
  }
  nlohmann::ordered_json evaluation = ToJson(report, path, config_, seed, true);
  evaluation["program"] = ProgramJson();
  WriteJson(directory_.evaluation(), evaluation);
  SayResult(report, path, fmt::format("--episodes {} --seed {}", episodes, seed));
  log_.Sync();
}

void TrainingRun::SayResult(const EvaluationReport& report, const std::string& policy,
                            const std::string& same_episodes) {
  const std::string skein = ProgramWord(), run = ShellWord(directory_.path());
  const std::string again = fmt::format("again           {} eval --policy {} --task {} {}", skein,
                                        run, config_.train.env.task, same_episodes);
  const std::string all = fmt::format(
      "{}\n"
      "policy          {}\n"
      "evaluation      {}\n"
      "metrics         {}  (tensorboard --logdir {})\n"
      "configuration   {}\n"
      "checkpoints     {}\n"
      "{}",
      ToText(report, true), policy, directory_.evaluation(), directory_.metrics(), run,
      directory_.config(), directory_.checkpoints(), again);
  const std::string in_short = fmt::format(
      "{}\n"
      "policy          {}\n"
      "all figures     {}/log.txt\n"
      "{}\n"
      "watch           {} replay --policy {} -o flights.acmi",
      ToSummary(report), policy, directory_.path(), again, skein, run);
  log_.Say(all, in_short);
}

void FollowRun(const ProgramConfig& config, const std::string& from, WorkerPool& pool,
               Ranks& ranks) {
  const std::unique_ptr<Trainer> trainer =
      MakeTrainer(config.train, pool, ranks, [&](Trainer& made) { StartNetworks(from, made); });
  Follow(config, *trainer, pool, ranks);
}

void FollowResumedRun(const ProgramConfig& config, const RunDirectory& directory, WorkerPool& pool,
                      Ranks& ranks) {
  const std::unique_ptr<Trainer> trainer =
      MakeTrainer(config.train, pool, ranks,
                  [&](Trainer& made) { RestoreNewest(directory.Checkpoints(), made); });
  Follow(config, *trainer, pool, ranks);
}

}  // namespace skein
