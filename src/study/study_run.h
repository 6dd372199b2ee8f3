// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/worker_pool.h"
#include "src/evaluation/quantities.h"
#include "src/study/study.h"
#include "train/files/file_descriptor.h"

namespace skein {

/// Carries a study out in a directory of its own, whose parts that are there already it keeps:
///   runs/TASK-LEVEL-seedN         the trainings (TASK-seedN if one serves all levels)
///   comparisons/TASK-LEVEL.json   the policies and agents under one level (Comparison)
///   results.csv, results.json     all of them so far
class StudyRun {
 public:
  /// Makes the directory and holds it exclusively. Throws Error on a configuration or agent of the
  /// study that cannot be, before there is a directory.
  StudyRun(const Study& study, const std::string& directory, WorkerPool& pool);

  /// Does what is left to do. Returns false if it was asked to stop (SIGINT, SIGTERM): the same
  /// call resumes bit-exactly. Throws Error if a run in the directory was trained with
  /// another configuration.
  bool Run();

  /// The table of all levels for people; without a newline at the end.
  std::string ToText() const;

  /// The directories of all trainings, in their order.
  std::vector<std::string> RunPaths() const;
  /// Of each level the comparison as a page shows it (ShownComparison), with `level`, its name.
  std::vector<nlohmann::ordered_json> ShownComparisons() const;

 private:
  std::string RunPath(const std::string& task, const StudyLevel& level, std::uint64_t seed) const;
  /// Says which of the study's trainings is the next.
  void SayTraining(const std::string& path) const;
  bool Train(const std::string& task, const StudyLevel& level, std::uint64_t seed);
  bool Evaluate(const std::string& task, const StudyLevel& level);
  /// Of all tasks and levels, each once.
  std::vector<Quantity> Measured() const;
  void WriteResults() const;

  const Study& study_;
  std::string directory_;
  WorkerPool& pool_;
  FileDescriptor lock_;
  nlohmann::ordered_json results_;  ///< array of task, level, comparison
};

}  // namespace skein
