#include "src/study_run.h"

#include <fmt/format.h>

#include <filesystem>

#include "simd/error.h"
#include "src/agent_names.h"
#include "src/comparison.h"
#include "src/configuration.h"
#include "src/evaluation_report.h"
#include "src/output_file.h"
#include "src/run_directory.h"
#include "src/run_signals.h"
#include "src/study_report.h"
#include "src/training_run.h"

namespace skein {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Removes what a process killed while it made a run's directory has left: no run is in it yet.
void RemoveStub(const std::string& run) {
  for (const char* name : {"/config.toml.tmp", "/lock", "/checkpoints"}) {
    std::error_code ignored;  // RunDirectory::Create says what is in the way
    fs::remove(run + name, ignored);
  }
}

/// The configuration of the run in `path`, which must be the one asked for.
ProgramConfig ConfigOfRun(const std::string& path, ProgramConfig asked) {
  ProgramConfig config;
  ApplyTomlFile(path + "/config.toml", &config);
  // What "auto" was on the machine that began it.
  if (asked.train.learner.precision == LearnerPrecision::kAuto) {
    asked.train.learner.precision = config.train.learner.precision;
  }
  if (const auto differences = Differences(config, asked); !differences.empty()) {
    throw Error(fmt::format(
        "{}: was trained with another configuration than the study asks for: {}; choose another "
        "--out, or remove it",
        path, differences.front()));
  }
  return config;
}

std::string NameOfSeed(std::uint64_t seed) { return fmt::format("seed {}", seed); }

/// What a comparison's document says if it is of these agents in this environment.
Json Identity(const Study& study, const ProgramConfig& config) {
  Json agents = Json::array();
  for (const std::uint64_t seed : study.seeds) agents.push_back(NameOfSeed(seed));
  for (const std::string& agent : study.agents) agents.push_back(agent);
  return {{"agents", agents},
          {"episodes", study.evaluation.episodes},
          {"seed", study.evaluation.seed},
          {"environment", EnvironmentJson(config)}};
}

bool HasIdentity(const Json& comparison, const Json& identity) {
  Json agents = Json::array();
  for (const Json& agent : comparison["agents"]) agents.push_back(agent["name"]);
  return agents == identity["agents"] && comparison["episodes"] == identity["episodes"] &&
         comparison["seed"] == identity["seed"] &&
         comparison["environment"] == identity["environment"];
}

}  // namespace

StudyRun::StudyRun(const Study& study, const std::string& directory, WorkerPool& pool)
    : study_(study),
      directory_(directory),
      pool_(pool),
      lock_(LockDirectory(MakeDirectories(directory))),
      results_(Json::array()) {
  for (const std::string& task : study_.tasks) {
    for (const StudyLevel& level : study_.levels) {
      TrainingConfig(study_, task, level, study_.seeds.front());
      const ProgramConfig config = EvaluationConfig(study_, task, level);
      for (const std::string& agent : study_.agents) {
        FindAgent(agent, config, study_.evaluation.seed);
      }
    }
  }
  MakeDirectories(directory_ + "/runs");
  MakeDirectories(directory_ + "/comparisons");
}

std::string StudyRun::RunPath(const std::string& task, const StudyLevel& level,
                              std::uint64_t seed) const {
  const std::string of_level = study_.training.per_level ? "-" + FileNamePart(level.name) : "";
  return fmt::format("{}/runs/{}{}-seed{}", directory_, task, of_level, seed);
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

bool StudyRun::Train(const std::string& task, const StudyLevel& level, std::uint64_t seed) {
  const std::string path = RunPath(task, level, seed);
  const ProgramConfig config = TrainingConfig(study_, task, level, seed);
  if (!IsRunDirectory(path)) {
    RemoveStub(path);
    TrainingRun::Begin(config, path, pool_);
  } else if (const ProgramConfig begun = ConfigOfRun(path, config);
             !fs::exists(path + "/evaluation.json")) {
    TrainingRun::Resume(begun, RunDirectory::Open(path), pool_);
  }
  return !pool_.stopping();
}

bool StudyRun::Evaluate(const std::string& task, const StudyLevel& level) {
  const std::string path =
      fmt::format("{}/comparisons/{}-{}.json", directory_, task, FileNamePart(level.name));
  const ProgramConfig config = EvaluationConfig(study_, task, level);
  Json document;
  if (fs::exists(path)) document = Json::parse(ReadFile(path));
  if (document.is_null() || !HasIdentity(document, Identity(study_, config))) {
    std::vector<NamedAgent> agents;
    for (const std::uint64_t seed : study_.seeds) {
      const std::string run = RunPath(task, level, seed);
      agents.push_back(
          {NameOfSeed(seed), FindAgent("policy:" + run, config, study_.evaluation.seed)});
    }
    for (const std::string& agent : study_.agents) {
      agents.push_back({agent, FindAgent(agent, config, study_.evaluation.seed)});
    }
    fmt::print("{}, {}: flying {} agents over {} episodes\n", task, level.name, agents.size(),
               study_.evaluation.episodes);
    const RunSignals signals(pool_);
    const Comparison comparison =
        Compare(agents, config, study_.evaluation.episodes, study_.evaluation.seed, pool_);
    if (pool_.stopping()) return false;
    document = ToJson(comparison, config);
    WriteFile(path, document.dump(1) + "\n");
  }
  results_.push_back({{"task", task}, {"level", level.name}, {"comparison", document}});
  return true;
}

void StudyRun::WriteResults() const {
  WriteFile(directory_ + "/results.csv", StudyCsv(results_, study_.seeds.size()));
  WriteFile(directory_ + "/results.json", results_.dump(1) + "\n");
}

std::string StudyRun::ToText() const { return StudyText(results_, study_.seeds.size()); }

}  // namespace skein
