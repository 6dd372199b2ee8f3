// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/worker_pool.h"
#include "src/run/training_run.h"
#include "src/study/study.h"
#include "train/ranks/ranks.h"

namespace skein {

/// What one training runs with.
struct TrainingSetup {
  ProgramConfig config;
  std::string low_level;  ///< what the low-level policy is, for people; empty without one
};

/// Throws Error if the task needs a low-level policy and the study has none.
TrainingSetup SetUpTraining(const Study& study, const std::string& task, const StudyLevel& level,
                            std::uint64_t seed);

/// The file whose networks the trainings of `task` start from; empty: fresh ones. Throws Error if
/// there is no such file.
std::string NetworksToStartFrom(const Study& study, const std::string& task);

/// The directory of a training of the study in `directory`: the same for all levels if one serves
/// them all.
std::string RunPath(const Study& study, const std::string& directory, const std::string& task,
                    const StudyLevel& level, std::uint64_t seed);

/// The trainings of a study. Several ranks share them out: each training is done by one rank alone,
/// and a rank that has nothing to do takes the next.
class StudyTrainings {
 public:
  /// All must outlive it.
  StudyTrainings(const Study& study, const std::string& directory, WorkerPool& pool, Ranks& ranks);

  /// The directories of all, each once, in their order.
  std::vector<std::string> Paths() const;

  /// On all ranks together: does what is left to do of the trainings in these directories. Returns
  /// false if it was asked to stop (SIGINT, SIGTERM): the same call resumes bit-exactly. Throws
  /// Error, on all ranks, if a run was trained with another configuration, or a training fails: the
  /// others then save and end, too.
  bool Train(const std::vector<std::string>& paths);

 private:
  struct Training {
    std::string task;
    const StudyLevel* level;
    std::uint64_t seed;
    std::string path;
  };

  std::vector<Training>::const_iterator Find(const std::string& path) const;
  TrainingSetup SetUp(const Training& training) const;
  bool IsLeft(const Training& training) const;
  /// Says which of the study's trainings is the next, on which rank; while this one trains, later,
  /// as its progress is drawn over and over.
  void Say(int index, int rank);
  void Print();
  void TrainOne(const Training& training, const GoesOn& goes_on);

  const Study& study_;
  WorkerPool& pool_;
  Ranks& ranks_;
  std::vector<Training> all_;
  bool is_training_ = false;
  std::string unsaid_;
};

}  // namespace skein
