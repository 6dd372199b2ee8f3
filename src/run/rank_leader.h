// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "base/worker_pool.h"
#include "src/run/run_signals.h"
#include "train/ppo/trainer.h"
#include "train/ranks/ranks.h"

namespace skein {

/// What rank 0 has all ranks do next: each is joint (train/ppo/trainer.h).
enum class RankCommand : std::uint64_t {
  kNone = 0,
  kIterate = 1,
  kSave = 2,
  kEnd = 4,
  kEvaluate = 8  ///< the final evaluation
};

/// On all ranks together: rank 0 says what comes next, and all learn it. A stop that any of them
/// was asked for since becomes all ranks', a save rank 0's.
RankCommand AgreeOnNext(Ranks& ranks, RunSignals& signals, RankCommand rank_zeros);

/// Rank 0's side of a training. When it goes, whatever the reason, the others end: not before, so
/// that what they are asked for in the meantime (signals) is heeded.
class RankLeader {
 public:
  explicit RankLeader(Ranks& ranks) : ranks_(ranks) {}
  ~RankLeader();
  RankLeader(const RankLeader&) = delete;
  RankLeader& operator=(const RankLeader&) = delete;

  void Say(RankCommand command, RunSignals& signals) { AgreeOnNext(ranks_, signals, command); }
  /// Before rank 0 takes signals.
  void Say(RankCommand command);

  Ranks& ranks() const { return ranks_; }

 private:
  Ranks& ranks_;
};

/// The side of all other ranks: until rank 0 ends. `evaluate` does this rank's part of kEvaluate.
void FollowLeader(Trainer& trainer, WorkerPool& pool, Ranks& ranks,
                  const std::function<void()>& evaluate);

/// A trainer on every rank, brought to its beginning by `begin`, which is called on each. Throws
/// Error on all if it cannot be done on one, or if ranks differ in the program's version, the SIMD
/// target, the configuration or the beginning, and names them.
std::unique_ptr<Trainer> MakeTrainer(const TrainConfig& config, WorkerPool& pool, Ranks& ranks,
                                     const std::function<void(Trainer&)>& begin);

/// On all ranks together: lines for people on who computes what, with a warning where a rank, or
/// the ranks of a machine, have more threads than processors that they may use; empty if there is
/// one rank.
std::string DescribeRanks(const TrainConfig& config, const WorkerPool& pool, Ranks& ranks);

}  // namespace skein
