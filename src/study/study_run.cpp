// SPDX-License-Identifier: Apache-2.0
#include "src/study/study_run.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>
#include <vector>

#include "base/choice_error.h"
#include "base/error.h"
#include "base/fnv_hash.h"
#include "envs/task_registry.h"
#include "src/agents/agent_names.h"
#include "src/bench/machine.h"
#include "src/config/configuration.h"
#include "src/config/usage_error.h"
#include "src/evaluation/comparison.h"
#include "src/files/output_file.h"
#include "src/files/text_table.h"
#include "src/report/report_data.h"
#include "src/run/run_directory.h"
#include "src/run/run_signals.h"
#include "train/policy/policy_environment.h"
#include "train/policy/recurrent_policy.h"
#include "train/ranks/collectives.h"

namespace skein {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Throws Error if a policy of `who` that is trained in `trained` cannot fly in `flown`.
void CheckFlies(const EnvConfig& trained, EnvConfig flown, const std::string& who) {
  const auto made_with = PolicyEnvironment(trained);
  AdoptView(made_with, &flown);
  CheckMadeWith(flown, made_with, who);
}

/// Throws Error on a configuration or agent of the study that cannot be.
void Check(const Study& study) {
  bool has_high_level = false;
  for (const std::string& task : study.tasks) {
    for (const StudyLevel& level : study.levels) {
      try {
        const ProgramConfig trained = SetUpTraining(study, task, level, study.seeds.front()).config;
        if (const std::string from = NetworksToStartFrom(study, task); !from.empty()) {
          RecurrentPolicy::Load(from).CheckMadeFor(trained.train.env, "training.from " + from);
        }
        has_high_level = has_high_level || NeedsLowLevel(trained.train.env);
        const ProgramConfig config = LevelConfig(study, task, level);
        AsUsage([&] { CheckFlies(trained.train.env, config.train.env, "what is trained"); });
        for (const std::string& agent : study.agents) {
          FindAgent(agent, config, study.evaluation.seed);
        }
      } catch (const UsageError& error) {
        throw UsageError(fmt::format("{}, level {}: {}", task, level.name, error.what()));
      } catch (const ChoiceError& error) {
        throw ChoiceError(fmt::format("{}, level {}: {}", task, level.name, error.what()));
      } catch (const Error& error) {
        throw Error(fmt::format("{}, level {}: {}", task, level.name, error.what()));
      }
    }
  }
  if (!has_high_level && !study.low_level.empty()) {
    throw UsageError("low_level is for tasks of a high-level policy, and the study has none");
  }
}

/// Of all that trainings and comparisons depend on.
std::string HashOf(const Study& study) {
  std::string text =
      fmt::format("{} episodes of seed {}\n", study.evaluation.episodes, study.evaluation.seed);
  for (const std::string& agent : study.agents) text += agent + FingerprintOfAgent(agent) + "\n";
  if (!study.low_level.empty()) {
    const std::string& low_level = study.low_level;
    text += FingerprintOfAgent(IsAutopilot(low_level) ? low_level : "policy:" + low_level);
  }
  for (const std::string& task : study.tasks) {
    for (const StudyLevel& level : study.levels) {
      text += DumpToml(LevelConfig(study, task, level));
      for (const std::uint64_t seed : study.seeds) {
        text += DumpToml(TrainingConfig(study, task, level, seed));
      }
    }
    if (const std::string from = NetworksToStartFrom(study, task); !from.empty()) {
      text += HexHash(ReadFile(from, kLargestRecord));
    }
  }
  return HexHash(text);
}

/// On all ranks together: flies them over the same episodes; nothing if it was asked to stop.
std::optional<Comparison> FlyAll(const std::vector<AgentInStudy>& agents,
                                 const ProgramConfig& config, const Study::Evaluation& evaluation,
                                 WorkerPool& pool, Ranks& ranks) {
  std::vector<NamedAgent> named;
  DoTogether(ranks, [&] {
    for (const AgentInStudy& agent : agents) {
      named.push_back({agent.shown, FindAgent(agent.name, config, evaluation.seed)});
    }
  });
  const RunSignals signals(pool);
  Comparison comparison = Compare(named, config, evaluation.episodes, evaluation.seed, pool, ranks);
  if (AgreeOnStop(ranks, pool)) return std::nullopt;
  return comparison;
}

/// Makes it with the folder by which a study is known, or throws ChoiceError if there is something
/// that is not a study.
const std::string& MakeStudyDirectory(const std::string& path) {
  std::error_code failure;
  const bool is_new = !fs::exists(path, failure) ||
                      (fs::is_directory(path, failure) && fs::is_empty(path, failure));
  if (!is_new && !fs::is_directory(path + "/comparisons", failure)) {
    throw ChoiceError(path +
                      ": exists and is neither a study nor an empty directory; choose another "
                      "--out");
  }
  MakeDirectories(path + "/comparisons");
  return path;
}

}  // namespace

StudyRun::StudyRun(const Study& study, const std::string& directory, WorkerPool& pool, Ranks& ranks)
    : study_(study),
      directory_(directory),
      pool_(pool),
      ranks_(ranks),
      trainings_(study, directory, pool, ranks),
      results_(study, directory) {
  DoTogether(ranks, [&] { Check(study); });
  if (ranks.count() > 1) {
    RequireSameOnRanks(ranks, "what they study", DescribeProgram() + ", study " + HashOf(study));
  }
  DoOnRankZero(ranks, [&] {
    lock_.emplace(LockDirectory(MakeStudyDirectory(directory)));
    MakeDirectories(directory_ + "/runs");
    CheckWritable({directory_ + "/results.csv", directory_ + "/results.json"});
  });
}

bool StudyRun::Run() {
  DoOnRankZero(ranks_, [this] {
    for (const std::string& cell : results_.ReadFinished()) {
      fmt::print("{}: left out of the results: the study would fly it otherwise now\n", cell);
    }
  });
  // So that no rank waits for the last training of a level.
  if (ranks_.count() > 1 && !trainings_.Train(trainings_.Paths())) return false;
  for (const std::string& task : study_.tasks) {
    for (const StudyLevel& level : study_.levels) {
      if (!trainings_.Train(RunPaths(task, level)) || !Evaluate(task, level)) return false;
      DoOnRankZero(ranks_, [this] { results_.Write(); });
    }
  }
  return true;
}

std::vector<std::string> StudyRun::RunPaths(const std::string& task,
                                            const StudyLevel& level) const {
  std::vector<std::string> paths;
  for (const std::uint64_t seed : study_.seeds) {
    paths.push_back(RunPath(study_, directory_, task, level, seed));
  }
  return paths;
}

bool StudyRun::Evaluate(const std::string& task, const StudyLevel& level) {
  const ProgramConfig config = LevelConfig(study_, task, level);
  const std::vector<AgentInStudy> agents =
      AgentsUnder(study_, directory_, task, level, study_.seeds);
  Json identity;  // rank 0's
  bool is_known = false;
  DoOnRankZero(ranks_, [&] {
    identity = IdentityOf(agents, study_, config);
    is_known = results_.ReadIfOf(identity, task, level);
  });
  if (UnionOverRanks(ranks_, is_known) != 0) return true;
  fmt::print("{}, {}: flying {} over {}\n", task, level.name,
             Counted(static_cast<int>(agents.size()), "agent"),
             Counted(study_.evaluation.episodes, "episode"));
  const auto comparison = FlyAll(agents, config, study_.evaluation, pool_, ranks_);
  if (!comparison) return false;
  DoOnRankZero(ranks_, [&] {
    Json document = ToJson(*comparison, config);
    document["program"] = ProgramJson();
    document["identity"] = identity;
    results_.Add(task, level, std::move(document));
  });
  return true;
}

std::vector<Json> StudyRun::ShownComparisons() const {
  std::vector<Json> shown;
  for (const StudyResults::Cell& cell : results_.Finished()) {
    const ProgramConfig config = LevelConfig(study_, cell.task, *cell.level);
    shown.push_back(ShownComparison(cell.comparison, config));
    shown.back()["level"] = cell.level->name;
  }
  return shown;
}

}  // namespace skein
