// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "base/worker_pool.h"
#include "envs/tasks/termination.h"
#include "train/network/backend.h"
#include "train/policy/recurrent_policy.h"
#include "train/ppo/train_config.h"
#include "train/ranks/ranks.h"

namespace skein {

/// What one iteration (rollout and update) did. All but the seconds is bit-identical for any number
/// of threads, and on all ranks.
struct IterationReport {
  /// The pool, of any rank, was asked to stop: nothing was done after all, and of the other fields
  /// only dropped_steps means anything.
  bool dropped = false;
  std::uint64_t dropped_steps = 0;  ///< control steps discarded
  std::uint64_t iteration = 0;
  std::uint64_t env_steps = 0;  ///< control steps flown since the start of training
  /// Episodes that ended in this iteration, but for first ones with a staggered clock.
  std::uint64_t episodes = 0;
  double return_mean = 0;  ///< of those; NaN if none
  double success_rate =
      0;  ///< of those, of missions the share that was flown to its end; NaN if none
  std::array<int, kNumTerminations> terminations{};  ///< of those
  int non_finite = 0;  ///< episodes that ended as non_finite, first ones with a staggered clock too
  double policy_loss = 0, value_loss = 0, entropy = 0, approximate_kl = 0, clip_fraction = 0;
  double action_change = 0;  ///< LossSums::action_change
  double actor_gradient_norm = 0, critic_gradient_norm = 0;
  double explained_variance = 0;
  double learning_rate = 0;  ///< the actor's
  double log_std_mean = 0;
  /// Deterministic success if this iteration evaluated, else -1.
  double evaluation_success_rate = -1;
  /// And its EvaluationResult::hold_within_mean; NaN without an evaluation, and without env.hold_s.
  double evaluation_hold_within = std::numeric_limits<double>::quiet_NaN();
  bool best = false;  ///< no evaluation so far had more success than this one
  double rollout_seconds = 0, update_seconds = 0, evaluation_seconds = 0;
  double simulator_seconds = 0;  ///< of the rollout, mean of the threads
  double gradient_seconds = 0;   ///< of the update: forward, losses and backward
  double wait_seconds = 0;       ///< of the update: UpdateReport::wait_seconds
};

/// What a checkpoint says of where it comes from.
struct CheckpointOrigin {
  std::string simd_target;  ///< that it was made on
  std::string records;      ///< as they were given to Trainer::Save
};

/// Recurrent PPO on a VecEnv. A run is a function of the configuration: same bits for any thread
/// count, and any number of ranks (by LibTorch but for rounding), interrupted or not. With several
/// ranks each flies its part of the shards, all take the same steps, and what is marked as joint is
/// called on all of them together.
class Trainer {
 public:
  /// Throws Error on a configuration that cannot be trained, or not on so many ranks. The pool and
  /// the ranks must outlive it.
  Trainer(const TrainConfig& config, WorkerPool& pool, Ranks& ranks = OneRank());
  ~Trainer();

  /// The configuration, its precision as it was chosen (train/network/backend.h).
  const TrainConfig& config() const;
  std::uint64_t env_steps() const;       ///< control steps flown so far
  std::uint64_t iteration() const;       ///< iterations done so far
  bool finished() const;                 ///< the step budget is used up
  const BackendChoice& backend() const;  ///< what computes the networks

  /// Joint: one rollout and update. Throws Error if a loss or gradient is not finite or explodes;
  /// the whole state is then that before the iteration, and can be saved. So it is if the pool was
  /// asked to stop, which takes no longer than a policy step of a tile of aircraft or the gradient
  /// of a tile of samples on its rank, and with several ranks until the others reach the next
  /// exchange: the end of the rollout or of a minibatch. All ranks throw alike; what goes wrong on
  /// one alone ends all processes.
  IterationReport Iterate();

  /// Takes over the networks of a policy file or checkpoint: the actor, its pedals idle or freed as
  /// ppo.pedals has it, and the critic with its value statistics if the file has them (returned).
  /// Optimiser, environment and counters stay as they are: for a training that has not begun.
  /// Throws Error if the file is damaged, or its policy is of other sizes, another task or
  /// environment; nothing has changed then.
  bool StartFrom(const std::string& path);

  /// What is evaluated and kept: the actor as it is now, or with ppo.average_iterations the mean of
  /// the last ones.
  RecurrentPolicy policy() const;

  /// Joint: everything needed to resume bit-exactly, written by rank 0 atomically (temporary file,
  /// fsync, rename, directory fsync). The file is the same for any number of ranks. `records` is
  /// kept for Restore to return.
  void Save(const std::string& path, const std::string& records = "") const;
  /// On another SIMD target than that of the checkpoint training resumes, but not bit-exactly.
  /// Throws Error if the file is damaged or was made with another configuration of
  /// networks, environment or learner, or another low-level policy; nothing has changed then.
  CheckpointOrigin Restore(const std::string& path);

  /// Joint: a 64-bit hash (FNV-1a) of parameters, optimiser, value statistics and environment
  /// state; on rank 0.
  std::uint64_t Signature() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein
