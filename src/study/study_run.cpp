// SPDX-License-Identifier: Apache-2.0
#include "src/study/study_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/fnv_hash.h"
#include "envs/task_registry.h"
#include "simd/target.h"
#include "src/agents/agent_names.h"
#include "src/agents/low_level_option.h"
#include "src/agents/policy_file.h"
#include "src/config/configuration.h"
#include "src/config/usage_error.h"
#include "src/evaluation/comparison.h"
#include "src/evaluation/evaluation_report.h"
#include "src/files/output_file.h"
#include "src/files/text_table.h"
#include "src/report/report_data.h"
#include "src/run/run_directory.h"
#include "src/run/run_signals.h"
#include "src/run/training_run.h"
#include "src/study/study_report.h"
#include "train/policy/low_level_file.h"
#include "train/policy/policy_environment.h"

namespace skein {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Removes what a process killed while it made a run's directory has left: no run is in it yet.
void RemoveStub(const std::string& run) {
  for (const char* name :
       {"/config.toml.tmp", "/low_level.skein", "/low_level.skein.tmp", "/task.toml",
        "/task.toml.tmp", "/aircraft.json", "/aircraft.json.tmp", "/lock", "/checkpoints"}) {
    std::error_code ignored;  // RunDirectory::Create says what is in the way
    fs::remove(run + name, ignored);
  }
}

/// The configuration of the run in `directory`, which must be the one asked for.
ProgramConfig ConfigOfRun(const RunDirectory& directory, ProgramConfig asked) {
  ProgramConfig config = ReadRecord(directory.config());
  config.train.low_level = LowLevelPolicyOfRun(directory, config.train.env);
  // What "auto" was on the machine that began it.
  if (asked.train.learner.precision == LearnerPrecision::kAuto) {
    asked.train.learner.precision = config.train.learner.precision;
  }
  std::vector<std::string> differences = Differences(config, asked);
  if (!IsSamePolicy(config.train.low_level.get(), asked.train.low_level.get())) {
    differences.push_back("another low-level policy");
  }
  if (!differences.empty()) {
    throw Error(fmt::format(
        "{}: was trained with another configuration than the study asks for: {}; choose another "
        "--out, or remove it",
        directory.path(), differences.front()));
  }
  return config;
}

struct AgentInStudy {
  std::string shown;
  std::string name;  ///< as of FindAgent
};

/// The file's FNV hash for a policy; for other agents nothing, as their names say all.
std::string Fingerprint(const std::string& agent) {
  const std::string file = PolicyFileOfAgent(agent);
  if (file.empty() || file == kUntrained) return "";
  const std::string bytes = ReadFile(file, kLargestRecord);
  FnvHash hash;
  hash.Add(bytes.data(), bytes.size());
  return hash.Hex();
}

/// What a comparison depends on.
Json Identity(const std::vector<AgentInStudy>& agents, const Study& study,
              const ProgramConfig& config) {
  Json names = Json::array(), quantities = Json::array();
  for (const AgentInStudy& agent : agents) {
    names.push_back({{"name", agent.shown}, {"policy", Fingerprint(agent.name)}});
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

/// The configuration of one training. Throws Error if the task needs a low-level policy and the
/// study has none.
ProgramConfig ConfigToTrain(const Study& study, const std::string& task, const StudyLevel& level,
                            std::uint64_t seed) {
  ProgramConfig config = TrainingConfig(study, task, level, seed);
  if (!NeedsLowLevel(config.train.env)) return config;
  if (study.low_level.empty()) {
    throw UsageError(fmt::format(
        "task {} needs low_level = \"RUN_OR_POLICY\", of task control, or \"autopilot\"", task));
  }
  config.train.low_level = ChooseLowLevelPolicy(config.train.env, study.low_level).policy;
  return config;
}

/// Throws Error if a policy of `who` that is trained in `trained` cannot fly in `flown`.
void CheckFlies(const EnvConfig& trained, EnvConfig flown, const std::string& who) {
  const auto made_with = PolicyEnvironment(trained);
  AdoptView(made_with, &flown);
  CheckMadeWith(flown, made_with, who);
}

/// The study. Throws Error on a configuration or agent of it that cannot be.
const Study& Checked(const Study& study) {
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
  return study;
}

/// Makes it, or throws Error if there is something in it that is not a study.
const std::string& MakeStudyDirectory(const std::string& path) {
  std::error_code failure;
  const bool is_new = !fs::exists(path, failure) || fs::is_empty(path, failure);
  if (!is_new && !fs::is_directory(path + "/comparisons", failure)) {
    throw Error(path + ": is not empty and holds no study; choose another --out");
  }
  return MakeDirectories(path);
}

}  // namespace

StudyRun::StudyRun(const Study& study, const std::string& directory, WorkerPool& pool)
    : study_(Checked(study)),
      directory_(directory),
      pool_(pool),
      lock_(LockDirectory(MakeStudyDirectory(directory))),
      results_(Json::array()) {
  MakeDirectories(directory_ + "/comparisons");
  MakeDirectories(directory_ + "/runs");
  CheckWritable({directory_ + "/results.csv", directory_ + "/results.json"});
}

std::string StudyRun::RunPath(const std::string& task, const StudyLevel& level,
                              std::uint64_t seed) const {
  const std::string of_level = study_.training.per_level ? "-" + FileNamePart(level.name) : "";
  return fmt::format("{}/runs/{}{}-seed{}", directory_, FileNamePart(task), of_level, seed);
}

bool StudyRun::Run() {
  for (const std::string& task : study_.tasks) {
    for (const StudyLevel& level : study_.levels) {
      for (const std::uint64_t seed : study_.seeds) {
        if (!Train(task, level, seed)) return false;
      }
      if (!Evaluate(task, level)) return false;
      WriteResults();
    }
  }
  return true;
}

std::vector<std::string> StudyRun::RunPaths() const {
  std::vector<std::string> paths;
  for (const std::string& task : study_.tasks) {
    for (const StudyLevel& level : study_.levels) {
      for (const std::uint64_t seed : study_.seeds) {
        const std::string other = RunPath(task, level, seed);
        if (std::find(paths.begin(), paths.end(), other) == paths.end()) paths.push_back(other);
      }
    }
  }
  return paths;
}

void StudyRun::SayTraining(const std::string& path) const {
  const std::vector<std::string> paths = RunPaths();
  const auto place = std::find(paths.begin(), paths.end(), path) - paths.begin();
  fmt::print("training {} of {}: {}\n", place + 1, paths.size(), path);
  std::fflush(stdout);
}

bool StudyRun::Train(const std::string& task, const StudyLevel& level, std::uint64_t seed) {
  const std::string path = RunPath(task, level, seed);
  const ProgramConfig config = ConfigToTrain(study_, task, level, seed);
  if (!IsRunDirectory(path)) {
    RemoveStub(path);
    SayTraining(path);
    TrainingRun::Begin(config, path, pool_);
    return !pool_.stopping();
  }
  RunDirectory directory = RunDirectory::Open(path);
  const ProgramConfig begun = ConfigOfRun(directory, config);
  if (!fs::exists(directory.evaluation())) {
    SayTraining(path);
    TrainingRun::Resume(begun, std::move(directory), pool_);
  }
  return !pool_.stopping();
}

bool StudyRun::Evaluate(const std::string& task, const StudyLevel& level) {
  const std::string path = fmt::format("{}/comparisons/{}-{}.json", directory_, FileNamePart(task),
                                       FileNamePart(level.name));
  const ProgramConfig config = LevelConfig(study_, task, level);
  std::vector<AgentInStudy> agents;
  for (const std::uint64_t seed : study_.seeds) {
    agents.push_back({fmt::format("seed {}", seed), "policy:" + RunPath(task, level, seed)});
  }
  for (const std::string& agent : study_.agents) agents.push_back({agent, agent});
  const Json identity = Identity(agents, study_, config);
  Json document = KnownComparison(path, identity);
  if (document.is_null()) {
    std::vector<NamedAgent> named;
    for (const AgentInStudy& agent : agents) {
      named.push_back({agent.shown, FindAgent(agent.name, config, study_.evaluation.seed)});
    }
    fmt::print("{}, {}: flying {} over {}\n", task, level.name,
               Counted(static_cast<int>(named.size()), "agent"),
               Counted(study_.evaluation.episodes, "episode"));
    const RunSignals signals(pool_);
    const Comparison comparison =
        Compare(named, config, study_.evaluation.episodes, study_.evaluation.seed, pool_);
    if (pool_.stopping()) return false;
    document = ToJson(comparison, config);
    document["identity"] = identity;
    WriteJson(path, document);
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
