// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "base/worker_pool.h"
#include "src/config/program_config.h"
#include "src/evaluation/evaluation_report.h"
#include "src/run/event_file.h"
#include "src/run/metrics.h"
#include "src/run/rank_leader.h"
#include "src/run/record_file.h"
#include "src/run/run_directory.h"
#include "src/run/run_log.h"
#include "src/run/run_signals.h"
#include "train/ppo/trainer.h"
#include "train/ranks/ranks.h"

namespace skein {

/// Is shown every iteration after its records are written; false ends the run as SIGTERM would.
using GoesOn = std::function<bool(const IterationReport&)>;

/// Who follows a run.
struct RunWatch {
  GoesOn goes_on = {};
  bool prints = true;  ///< on the standard output; log.txt has it either way
};

/// Where a new run comes from, beside its configuration.
struct RunOrigin {
  std::string preset;     ///< name of the preset; empty if not known
  std::string low_level;  ///< what the low-level policy is, for people; empty without one
  std::string from;       ///< policy file or checkpoint whose networks it starts from; or empty
  RunWatch watch = {};
  std::string* directory = nullptr;  ///< is told where the run is, unless null
};

/// One training run in its directory: iterations, records, checkpoints, signals, and at the end the
/// evaluation over fresh episodes. With several ranks this is rank 0's, which leads the others
/// (FollowRun), and writes and says everything.
class TrainingRun {
 public:
  /// A new run in a new directory: `path`, or one in kRunsRoot if that is empty. Returns the signal
  /// that ended it early, or 0. Throws Error if it cannot be made, or `origin.from` does not fit
  /// the configuration.
  static int Begin(const ProgramConfig& config, const std::string& path, WorkerPool& pool,
                   const RunOrigin& origin = {}, Ranks& ranks = OneRank());
  /// Resumes the directory's newest checkpoint, or the start if it has none, over the low-level
  /// policy that the run began with; `watch` and what is returned are those of a new run. Throws
  /// Error if the checkpoint is damaged or made with another configuration.
  static int Resume(const ProgramConfig& config, RunDirectory directory, WorkerPool& pool,
                    RunWatch watch = {}, Ranks& ranks = OneRank());

 private:
  /// `begun`: when the program's part in the run began.
  TrainingRun(const ProgramConfig& config, RunDirectory directory, Trainer& trainer,
              WorkerPool& pool, RankLeader& leader, std::string ranks,
              std::chrono::steady_clock::time_point begun, RunWatch watch);

  /// To the end, or until it is stopped; says in the log what ended it. Returns the signal that
  /// did, or 0.
  int Run();
  void TrainAndEvaluate();
  void SayBanner();
  IterationReport Iterate();
  void Record(const IterationReport& report);
  void Save(const std::string& path);
  void SaveCheckpoint();
  bool CheckpointIsDue() const;
  void Finish();
  /// What the final evaluation gave. `same_episodes` are the options of skein eval that ask for it.
  void SayResult(const EvaluationReport& report, const std::string& policy,
                 const std::string& same_episodes);
  void SayStopped(const std::string& dropped);

  ProgramConfig config_;
  RunDirectory directory_;
  Trainer& trainer_;
  WorkerPool& pool_;
  RankLeader& leader_;
  std::string ranks_;  ///< for people; empty if there is one
  RunSignals signals_;
  RunLog log_;
  RecordFile metrics_, timing_;
  EventFile events_;
  GoesOn goes_on_;
  std::chrono::steady_clock::time_point last_save_;
  std::chrono::steady_clock::time_point turn_begin_;  ///< when the row before was made
  TurnSeconds turn_;                                  ///< what is known of the next row's
  std::uint64_t saved_iteration_ = 0;
};

/// The part of every rank but 0 in a run that rank 0 begins, or resumes from `directory`: until
/// that ends. `from` is as of RunOrigin.
void FollowRun(const ProgramConfig& config, const std::string& from, WorkerPool& pool,
               Ranks& ranks);
void FollowResumedRun(const ProgramConfig& config, const RunDirectory& directory, WorkerPool& pool,
                      Ranks& ranks);

}  // namespace skein
