// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/worker_pool.h"
#include "src/study/study.h"
#include "src/study/study_results.h"
#include "src/study/study_trainings.h"
#include "train/files/file_descriptor.h"
#include "train/ranks/ranks.h"

namespace skein {

/// Carries a study out in a directory of its own, whose parts that are there already it keeps:
///   runs/TASK-LEVEL-seedN         the trainings (TASK-seedN if one serves all levels)
///   comparisons/TASK-LEVEL.json   the policies and agents under one level (Comparison)
///   results.csv, results.json     all of them so far, of levels carried out earlier, too
class StudyRun {
 public:
  /// On all ranks together: rank 0 makes the directory and holds it exclusively. Throws Error on a
  /// configuration or agent of the study that cannot be, or if ranks compute or study differently,
  /// before there is a directory.
  StudyRun(const Study& study, const std::string& directory, WorkerPool& pool,
           Ranks& ranks = OneRank());

  /// On all ranks together: does what is left to do. Several ranks share out all trainings first,
  /// then the episodes of every level; the files are the same. Returns false if it was asked to
  /// stop (SIGINT, SIGTERM): the same call resumes bit-exactly. Throws Error if a run in the
  /// directory was trained with another configuration.
  bool Run();

  /// The table of the levels carried out, for people, on rank 0; without a newline at the end.
  std::string ToText() const { return results_.ToText(); }

  /// The directories of all trainings whose results there are, on rank 0.
  std::vector<std::string> RunPaths() const { return results_.RunPaths(); }
  /// Of each result the comparison as a page shows it (ShownComparison), with `level`, its name; on
  /// rank 0.
  std::vector<nlohmann::ordered_json> ShownComparisons() const;

 private:
  /// Of the trainings that serve a level.
  std::vector<std::string> RunPaths(const std::string& task, const StudyLevel& level) const;
  bool Evaluate(const std::string& task, const StudyLevel& level);

  const Study& study_;
  std::string directory_;
  WorkerPool& pool_;
  Ranks& ranks_;
  StudyTrainings trainings_;
  std::optional<FileDescriptor> lock_;  ///< rank 0's
  StudyResults results_;                ///< of rank 0 alone
};

}  // namespace skein
