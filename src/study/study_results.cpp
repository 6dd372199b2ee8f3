// SPDX-License-Identifier: Apache-2.0
#include "src/study/study_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <utility>

#include "base/error.h"
#include "simd/target.h"
#include "src/agents/agent_names.h"
#include "src/config/configuration.h"
#include "src/evaluation/evaluation_report.h"
#include "src/files/output_file.h"
#include "src/study/study_report.h"
#include "src/study/study_trainings.h"

namespace skein {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The document in the file `path`; null if it is not there, or not whole.
Json ReadComparison(const std::string& path) {
  if (!fs::exists(path)) return nullptr;
  Json document = Json::parse(ReadFile(path), nullptr, false);
  return document.is_object() ? document : nullptr;
}

Json ResultsJson(const std::vector<StudyResults::Cell>& cells) {
  Json results = Json::array();
  for (const StudyResults::Cell& cell : cells) {
    results.push_back(
        {{"task", cell.task}, {"level", cell.level->name}, {"comparison", cell.comparison}});
  }
  return results;
}

}  // namespace

std::vector<AgentInStudy> AgentsUnder(const Study& study, const std::string& directory,
                                      const std::string& task, const StudyLevel& level,
                                      const std::vector<std::uint64_t>& seeds) {
  std::vector<AgentInStudy> agents;
  for (const std::uint64_t seed : seeds) {
    agents.push_back({fmt::format("{}{}", kSeedPrefix, seed),
                      "policy:" + RunPath(study, directory, task, level, seed)});
  }
  for (const std::string& agent : study.agents) agents.push_back({agent, agent});
  return agents;
}

Json IdentityOf(const std::vector<AgentInStudy>& agents, const Study& study,
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

StudyResults::StudyResults(const Study& study, const std::string& directory)
    : study_(study), directory_(directory) {
  for (const std::string& task : study.tasks) {
    for (const StudyLevel& level : study.all_levels) {
      const bool is_chosen =
          std::any_of(study.levels.begin(), study.levels.end(),
                      [&level](const StudyLevel& chosen) { return chosen.name == level.name; });
      cells_.push_back({task, &level, is_chosen, nullptr});
    }
  }
}

std::vector<std::string> StudyResults::ReadFinished() {
  std::vector<std::string> left_out;
  for (Cell& cell : cells_) {
    Json comparison = ReadComparison(PathOf(cell));
    if (comparison.is_null()) continue;
    if (IsCurrent(cell, comparison)) {
      cell.comparison = std::move(comparison);
    } else if (!cell.is_chosen) {
      left_out.push_back(cell.task + ", " + cell.level->name);
    }
  }
  return left_out;
}

bool StudyResults::IsCurrent(const Cell& cell, const Json& comparison) const {
  try {
    const auto agents =
        AgentsUnder(study_, directory_, cell.task, *cell.level, SeedsOf(comparison));
    const ProgramConfig config = LevelConfig(study_, cell.task, *cell.level);
    return comparison.at("identity") == IdentityOf(agents, study_, config);
  } catch (const Json::exception&) {  // of another form
    return false;
  } catch (const Error&) {  // without its policies, or under what the level is no more
    return false;
  }
}

bool StudyResults::ReadIfOf(const Json& identity, const std::string& task,
                            const StudyLevel& level) {
  Cell& cell = At(task, level);
  Json comparison = ReadComparison(PathOf(cell));
  if (comparison.is_null() || comparison.value("identity", Json()) != identity) return false;
  cell.comparison = std::move(comparison);
  return true;
}

void StudyResults::Add(const std::string& task, const StudyLevel& level, Json comparison) {
  Cell& cell = At(task, level);
  WriteJson(PathOf(cell), comparison);
  cell.comparison = std::move(comparison);
}

StudyResults::Cell& StudyResults::At(const std::string& task, const StudyLevel& level) {
  return *std::find_if(cells_.begin(), cells_.end(), [&](const Cell& cell) {
    return cell.task == task && cell.level->name == level.name;
  });
}

std::string StudyResults::PathOf(const Cell& cell) const {
  return fmt::format("{}/comparisons/{}-{}.json", directory_, FileNamePart(cell.task),
                     FileNamePart(cell.level->name));
}

std::vector<StudyResults::Cell> StudyResults::Finished() const {
  std::vector<Cell> finished;
  std::copy_if(cells_.begin(), cells_.end(), std::back_inserter(finished),
               [](const Cell& cell) { return !cell.comparison.is_null(); });
  return finished;
}

std::vector<std::string> StudyResults::RunPaths() const {
  std::vector<std::string> paths;
  for (const Cell& cell : Finished()) {
    for (const std::uint64_t seed : SeedsOf(cell.comparison)) {
      const std::string path = RunPath(study_, directory_, cell.task, *cell.level, seed);
      if (std::find(paths.begin(), paths.end(), path) == paths.end()) paths.push_back(path);
    }
  }
  return paths;
}

std::vector<Quantity> StudyResults::Measured() const {
  std::vector<Quantity> all;
  for (const Cell& cell : cells_) {
    if (!cell.is_chosen && cell.comparison.is_null()) continue;
    for (Quantity& quantity : QuantitiesOf(LevelConfig(study_, cell.task, *cell.level).train.env)) {
      const bool is_known = std::any_of(
          all.begin(), all.end(), [&](const Quantity& other) { return other.key == quantity.key; });
      if (!is_known) all.push_back(std::move(quantity));
    }
  }
  return all;
}

void StudyResults::Write() const {
  const Json results = ResultsJson(Finished());
  WriteFile(directory_ + "/results.csv", StudyCsv(results, Measured()));
  WriteJson(directory_ + "/results.json", results);
}

std::string StudyResults::ToText() const {
  std::vector<Cell> shown = Finished();
  shown.erase(
      std::remove_if(shown.begin(), shown.end(), [](const Cell& cell) { return !cell.is_chosen; }),
      shown.end());
  return StudyText(ResultsJson(shown), Measured());
}

}  // namespace skein
