// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/evaluation/quantities.h"
#include "src/study/study.h"

namespace skein {

struct AgentInStudy {
  std::string shown;
  std::string name;  ///< as of FindAgent
};

/// What flies under a level: the policies of `seeds`, then the study's agents.
std::vector<AgentInStudy> AgentsUnder(const Study& study, const std::string& directory,
                                      const std::string& task, const StudyLevel& level,
                                      const std::vector<std::uint64_t>& seeds);

/// What is finished of the study in a directory, in the order of its file: levels that are not
/// carried out this time (StudyChoice) are among it, with the seeds that they were carried out
/// with.
class StudyResults {
 public:
  /// A task under a level.
  struct Cell {
    std::string task;
    const StudyLevel* level = nullptr;
    bool is_chosen = false;             ///< is carried out this time
    nlohmann::ordered_json comparison;  ///< null: not finished
  };

  /// The study must outlive it.
  StudyResults(const Study& study, const std::string& directory);

  /// Takes what comparisons/ holds that the study would fly no otherwise. Returns what is left out
  /// of levels that are not chosen, "TASK, LEVEL".
  std::vector<std::string> ReadFinished();
  /// Takes the comparison from comparisons/ if it is there, whole, and of this identity.
  bool ReadIfOf(const nlohmann::ordered_json& identity, const std::string& task,
                const StudyLevel& level);
  /// Takes a comparison and writes it to comparisons/.
  void Add(const std::string& task, const StudyLevel& level, nlohmann::ordered_json comparison);
  /// results.csv and results.json.
  void Write() const;

  /// What was carried out this time, for people; without a newline at the end.
  std::string ToText() const;
  std::vector<Cell> Finished() const;
  /// The directories of its trainings, each once.
  std::vector<std::string> RunPaths() const;

 private:
  Cell& At(const std::string& task, const StudyLevel& level);
  std::string PathOf(const Cell& cell) const;
  bool IsCurrent(const Cell& cell, const nlohmann::ordered_json& comparison) const;
  /// Of all that is finished or chosen, each once.
  std::vector<Quantity> Measured() const;

  const Study& study_;
  std::string directory_;
  std::vector<Cell> cells_;
};

/// What a comparison depends on.
nlohmann::ordered_json IdentityOf(const std::vector<AgentInStudy>& agents, const Study& study,
                                  const ProgramConfig& config);

}  // namespace skein
