// SPDX-License-Identifier: Apache-2.0
#include "src/study/study_trainings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "base/error.h"
#include "envs/task_registry.h"
#include "src/agents/low_level_option.h"
#include "src/agents/policy_file.h"
#include "src/config/configuration.h"
#include "src/config/task_file.h"
#include "src/config/usage_error.h"
#include "src/files/output_file.h"
#include "src/run/recorded_run.h"
#include "src/run/run_directory.h"
#include "src/run/run_signals.h"
#include "train/policy/low_level_file.h"
#include "train/ranks/collectives.h"
#include "train/ranks/task_share.h"

namespace skein {
namespace {

namespace fs = std::filesystem;

/// The configuration of the run in `directory`, which must be the one asked for, and have been
/// started from the networks in the file `networks` (WasStartedFrom).
ProgramConfig ConfigOfRun(const RunDirectory& directory, const ProgramConfig& asked,
                          const std::string& networks) {
  ProgramConfig config = RecordedConfig(directory);
  std::vector<std::string> differences = DifferencesFromRecord(config, asked);
  if (!IsSamePolicy(config.train.low_level.get(), asked.train.low_level.get())) {
    differences.push_back("another low-level policy");
  }
  if (!WasStartedFrom(directory, networks)) {
    differences.push_back("other networks to start from (training.from)");
  }
  if (!differences.empty()) {
    throw Error(fmt::format(
        "{}: was trained with another configuration than the study asks for: {}; choose another "
        "--out, or remove it",
        directory.path(), differences.front()));
  }
  return config;
}

}  // namespace

TrainingSetup SetUpTraining(const Study& study, const std::string& task, const StudyLevel& level,
                            std::uint64_t seed) {
  TrainingSetup setup{TrainingConfig(study, task, level, seed), ""};
  TrainConfig& train = setup.config.train;
  if (!NeedsLowLevel(train.env)) return setup;
  if (study.low_level.empty()) {
    throw UsageError(fmt::format(
        "task {} needs low_level = \"RUN_OR_POLICY\", of task control, or \"autopilot\"", task));
  }
  const ChosenLowLevelPolicy chosen = ChooseLowLevelPolicy(train.env, study.low_level);
  train.low_level = chosen.policy;
  setup.low_level = chosen.description;
  return setup;
}

std::string NetworksToStartFrom(const Study& study, const std::string& task) {
  if (study.training.from.empty()) return "";
  const auto at = std::find(study.tasks.begin(), study.tasks.end(), task) - study.tasks.begin();
  return NetworksFileOf(study.training.from[static_cast<std::size_t>(at)]);
}

std::string RunPath(const Study& study, const std::string& directory, const std::string& task,
                    const StudyLevel& level, std::uint64_t seed) {
  const std::string of_level = study.training.per_level ? "-" + FileNamePart(level.name) : "";
  return fmt::format("{}/runs/{}{}-seed{}", directory, FileNamePart(task), of_level, seed);
}

StudyTrainings::StudyTrainings(const Study& study, const std::string& directory, WorkerPool& pool,
                               Ranks& ranks)
    : study_(study), pool_(pool), ranks_(ranks) {
  for (const std::string& task : study.tasks) {
    for (const StudyLevel& level : study.levels) {
      for (const std::uint64_t seed : study.seeds) {
        const std::string path = RunPath(study, directory, task, level, seed);
        if (Find(path) == all_.end()) all_.push_back({task, &level, seed, path});
      }
    }
  }
}

std::vector<StudyTrainings::Training>::const_iterator StudyTrainings::Find(
    const std::string& path) const {
  return std::find_if(all_.begin(), all_.end(),
                      [&](const Training& training) { return training.path == path; });
}

std::vector<std::string> StudyTrainings::Paths() const {
  std::vector<std::string> paths;
  for (const Training& training : all_) paths.push_back(training.path);
  return paths;
}

TrainingSetup StudyTrainings::SetUp(const Training& training) const {
  return SetUpTraining(study_, training.task, *training.level, training.seed);
}

bool StudyTrainings::Train(const std::vector<std::string>& paths) {
  std::vector<int> left;
  DoOnRankZero(ranks_, [&] {
    for (const std::string& path : paths) {
      const auto training = Find(path);
      if (IsLeft(*training)) left.push_back(static_cast<int>(training - all_.begin()));
    }
  });
  const RunSignals signals(pool_);
  TaskShare share(ranks_, pool_, left, [&](int index, int rank) { Say(index, rank); });
  return share.Do([&](int index) {
    is_training_ = true;
    TrainOne(all_[static_cast<std::size_t>(index)],
             [&](const IterationReport&) { return share.GoesOn(); });
    is_training_ = false;
    Print();
  });
}

bool StudyTrainings::IsLeft(const Training& training) const {
  if (!IsRunDirectory(training.path)) return true;
  const RunDirectory directory = RunDirectory::Visit(training.path);
  ConfigOfRun(directory, SetUp(training).config, NetworksToStartFrom(study_, training.task));
  return !fs::exists(directory.evaluation());
}

void StudyTrainings::Say(int index, int rank) {
  const std::string where = ranks_.count() > 1 ? " on " + ranks_.Describe(rank) : "";
  unsaid_ += fmt::format("training {} of {}{}: {}\n", index + 1, all_.size(), where,
                         all_[static_cast<std::size_t>(index)].path);
  if (!is_training_) Print();
}

void StudyTrainings::Print() {
  fmt::print("{}", std::exchange(unsaid_, ""));
  std::fflush(stdout);
}

void StudyTrainings::TrainOne(const Training& training, const GoesOn& goes_on) {
  const TrainingSetup setup = SetUp(training);
  const std::string from = NetworksToStartFrom(study_, training.task);
  if (!IsRunDirectory(training.path)) {
    RunDirectory::RemoveStub(training.path);
    RunOrigin origin;
    origin.preset = IsTaskFile(training.task) ? "of " + training.task : study_.preset;
    origin.low_level = setup.low_level;
    origin.from = from;
    origin.watch.goes_on = goes_on;
    TrainingRun::Begin(setup.config, training.path, pool_, origin);
    return;
  }
  RunDirectory directory = RunDirectory::Open(training.path);
  const ProgramConfig begun = ConfigOfRun(directory, setup.config, from);
  TrainingRun::Resume(begun, std::move(directory), pool_, {goes_on});
}

}  // namespace skein
