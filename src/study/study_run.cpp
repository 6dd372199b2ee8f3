// SPDX-License-Identifier: Apache-2.0
#include "src/study/study_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/fnv_hash.h"
#include "envs/task_registry.h"
#include "simd/target.h"
#include "src/agents/agent_names.h"
#include "src/bench/machine.h"
#include "src/config/configuration.h"
#include "src/config/usage_error.h"
#include "src/evaluation/comparison.h"
#include "src/evaluation/evaluation_report.h"
#include "src/files/output_file.h"
#include "src/files/text_table.h"
#include "src/report/report_data.h"
#include "src/run/run_directory.h"
#include "src/run/run_signals.h"
#include "src/study/study_report.h"
#include "train/policy/policy_environment.h"
#include "train/ranks/collectives.h"

namespace skein {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct AgentInStudy {
  std::string shown;
  std::string name;  ///< as of FindAgent
};

/// What a comparison depends on.
Json Identity(const std::vector<AgentInStudy>& agents, const Study& study,
              const ProgramConfig& config) {
  Json names = Json::array(), quantities = Json::array();
  for (const AgentInStudy& agent : agents) {
    names.push_back({{"name", agent.shown}, {"policy", FingerprintOfAgent(agent.name)}});
  }
  for (const Quantity& quantity : QuantitiesOf(config.train.env)) {
    quantities.push_back(quantity.key);
  }
  return {{"agents", names},
          {"episodes", study.evaluation.episodes},
          {"seed", study.evaluation.seed},
          {"environment", EnvironmentJson(config)},
          {"simd", Name(simd::ActiveTarget())},
          {"quantities", quantities}};
}

/// The comparison in the file `path` if it is there, whole, and of this identity; else null.
Json KnownComparison(const std::string& path, const Json& identity) {
  if (!fs::exists(path)) return nullptr;
  Json document = Json::parse(ReadFile(path), nullptr, false);
  if (!document.is_object() || document.value("identity", Json()) != identity) return nullptr;
  return document;
}

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
        const ProgramConfig trained = ConfigToTrain(study, task, level, study.seeds.front());
        has_high_level = has_high_level || NeedsLowLevel(trained.train.env);
        const ProgramConfig config = LevelConfig(study, task, level);
        AsUsage([&] { CheckFlies(trained.train.env, config.train.env, "what is trained"); });
        for (const std::string& agent : study.agents) {
          FindAgent(agent, config, study.evaluation.seed);
        }
      } catch (const UsageError& error) {
        throw UsageError(fmt::format("{}, level {}: {}", task, level.name, error.what()));
      } catch (const Error& error) {
        throw Error(fmt::format("{}, level {}: {}", task, level.name, error.what()));
      }
    }
  }
  if (!has_high_level && !study.low_level.empty()) {
    throw UsageError("low_level is for tasks of a high-level policy, and the study has none");
  }
}

/// Of all configurations.
std::string HashOf(const Study& study) {
  std::string text;
  for (const std::string& task : study.tasks) {
    for (const StudyLevel& level : study.levels) {
      text += DumpToml(LevelConfig(study, task, level));
      for (const std::uint64_t seed : study.seeds) {
        text += DumpToml(TrainingConfig(study, task, level, seed));
      }
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

/// Makes it with the folder by which a study is known, or throws Error if there is something in it
/// that is not a study.
const std::string& MakeStudyDirectory(const std::string& path) {
  std::error_code failure;
  const bool is_new = !fs::exists(path, failure) || fs::is_empty(path, failure);
  if (!is_new && !fs::is_directory(path + "/comparisons", failure)) {
    throw Error(path + ": is not empty and holds no study; choose another --out");
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
      results_(Json::array()) {
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
  // So that no rank waits for the last training of a level.
  if (ranks_.count() > 1 && !trainings_.Train(trainings_.Paths())) return false;
  for (const std::string& task : study_.tasks) {
    for (const StudyLevel& level : study_.levels) {
      if (!trainings_.Train(RunPaths(task, level)) || !Evaluate(task, level)) return false;
      DoOnRankZero(ranks_, [this] { WriteResults(); });
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
  const std::string path = fmt::format("{}/comparisons/{}-{}.json", directory_, FileNamePart(task),
                                       FileNamePart(level.name));
  const ProgramConfig config = LevelConfig(study_, task, level);
  std::vector<AgentInStudy> agents;
  for (const std::uint64_t seed : study_.seeds) {
    agents.push_back(
        {fmt::format("seed {}", seed), "policy:" + RunPath(study_, directory_, task, level, seed)});
  }
  for (const std::string& agent : study_.agents) agents.push_back({agent, agent});
  Json identity, document;  // rank 0's
  DoOnRankZero(ranks_, [&] {
    identity = Identity(agents, study_, config);
    document = KnownComparison(path, identity);
  });
  if (UnionOverRanks(ranks_, document.is_null() ? 0 : 1) == 0) {
    fmt::print("{}, {}: flying {} over {}\n", task, level.name,
               Counted(static_cast<int>(agents.size()), "agent"),
               Counted(study_.evaluation.episodes, "episode"));
    const auto comparison = FlyAll(agents, config, study_.evaluation, pool_, ranks_);
    if (!comparison) return false;
    DoOnRankZero(ranks_, [&] {
      document = ToJson(*comparison, config);
      document["identity"] = identity;
      WriteJson(path, document);
    });
  }
  results_.push_back({{"task", task}, {"level", level.name}, {"comparison", document}});
  return true;
}

std::vector<Quantity> StudyRun::Measured() const {
  std::vector<Quantity> all;
  for (const std::string& task : study_.tasks) {
    for (const StudyLevel& level : study_.levels) {
      for (Quantity& quantity : QuantitiesOf(LevelConfig(study_, task, level).train.env)) {
        const bool is_known = std::any_of(all.begin(), all.end(), [&](const Quantity& other) {
          return other.key == quantity.key;
        });
        if (!is_known) all.push_back(std::move(quantity));
      }
    }
  }
  return all;
}

void StudyRun::WriteResults() const {
  WriteFile(directory_ + "/results.csv", StudyCsv(results_, study_.seeds.size(), Measured()));
  WriteJson(directory_ + "/results.json", results_);
}

std::vector<Json> StudyRun::ShownComparisons() const {
  std::vector<Json> shown;
  auto result = results_.begin();
  for (const std::string& task : study_.tasks) {
    for (const StudyLevel& level : study_.levels) {
      shown.push_back(ShownComparison((*result++)["comparison"], LevelConfig(study_, task, level)));
      shown.back()["level"] = level.name;
    }
  }
  return shown;
}

std::string StudyRun::ToText() const {
  return StudyText(results_, study_.seeds.size(), Measured());
}

}  // namespace skein
