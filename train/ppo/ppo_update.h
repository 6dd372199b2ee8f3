// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "base/worker_pool.h"
#include "train/ppo/actor_critic.h"
#include "train/ppo/learning_rate.h"
#include "train/ppo/minibatches.h"
#include "train/ppo/rollout.h"
#include "train/ppo/train_config.h"
#include "train/ranks/ranks.h"

namespace skein {

/// What an update did: means over all minibatches.
struct UpdateReport {
  bool stopped = false;  ///< some rank's pool was asked to stop: it is unfinished
  LossSums losses;
  double actor_gradient_norm = 0, critic_gradient_norm = 0;  ///< before clipping
  double gradient_seconds = 0;  ///< in forward, losses and backward, of all minibatches
  /// In which this thread waited for another to exchange gradients and take a step.
  double wait_seconds = 0;
};

/// PPO's epochs over a rollout: minibatches of shuffled chunks. What a shard has in one is cut into
/// a fixed number of slices; the gradients of slices and shards are summed in a fixed order, so
/// that no bit depends on the threads. Of several ranks, while the gradients of one network are
/// computed, another thread exchanges those of the other and takes its step.
class PpoUpdate {
 public:
  /// `networks`, `pool` and `ranks` must outlive the update.
  PpoUpdate(const TrainConfig& config, ActorCritic& networks, WorkerPool& pool,
            Ranks& ranks = OneRank());

  /// `iteration` keys the shuffles; `handling_weight` multiplies the action smoothness. Throws
  /// Error, on all ranks alike, if a loss or a gradient is not finite, or a gradient's norm exceeds
  /// kExplodedGradientNorm (train/ppo/clipped_step.h); parameters may then have moved. So they
  /// may if a pool is stopping: the update then ends within a tile of its rank, unfinished.
  UpdateReport Run(const Rollout& rollout, const ValueScale& scale, std::uint64_t iteration,
                   const LearningRates& learning_rates, double handling_weight = 1);

  /// Whether Run has thrown because training exploded.
  bool exploded() const { return exploded_; }

 private:
  /// What ranks sum beside a gradient.
  struct Beside {
    LossSums losses;
    int stopping = 0;  ///< ranks whose pool is
    void operator+=(const Beside& theirs) {
      losses += theirs.losses;
      stopping += theirs.stopping;
    }
  };
  /// A network and its gradient: [shard][slice] accumulators and sums of losses.
  struct Side {
    const char* name;
    double LossSums::*loss;
    TrainedNetwork& trained;
    std::vector<AlignedVector<float>> accumulators{};
    std::vector<LossSums> losses{};
    Beside beside{};  ///< of this rank's accumulators, then of all ranks'
    double norm = 0;
  };
  /// A network whose gradient other ranks' are added to, and whose step is taken, meanwhile.
  struct Stepping {
    Side* side = nullptr;
    std::future<void> done;
  };
  /// What samples are gathered from, and the scale in which the losses see them.
  struct Source {
    const Rollout& rollout;
    ValueScale value_scale;
    double advantage_mean = 0, advantage_inverse_std = 1;
  };
  /// A minibatch's chunks, by shard, and how they are cut.
  struct Minibatch {
    std::vector<Chunks> shards;
    int slices = 1;     ///< of each shard
    double chunks = 0;  ///< of all shards of the training
  };
  struct Gathered;

  bool is_actor(const Side& side) const { return &side == &sides_[0]; }
  Source SourceOf(const Rollout& rollout, const ValueScale& scale);
  /// Of what a shard has in a minibatch.
  int Slices(int chunks, const ShardRange& shards) const;
  Minibatch Cut(std::vector<Chunks> shards, const Rollout& rollout) const;
  /// What of a shard's chunks belongs to a slice.
  Chunks SliceOf(const Chunks& shard, int slice, int slices) const;
  LossSettings SettingsFor(const Minibatch& minibatch, int chunk_length) const;
  /// Whether the ranks compute one network after the other: unless some rank's threads had less to
  /// do then.
  bool IsOneByOne(const Rollout& rollout);
  /// One step of both optimisers; adds their losses and norms. False if a pool is stopping.
  bool StepTogether(const Source& source, const Minibatch& minibatch,
                    const LearningRates& learning_rates, UpdateReport& report);
  /// Computes a minibatch's gradients while the step that was begun before them is taken, and
  /// begins the next. False if a pool is stopping.
  bool StepOneByOne(const Source& source, const Minibatch& minibatch,
                    const LearningRates& learning_rates, Stepping& stepping, UpdateReport& report);
  /// Waits for a step that was begun, if there is one, and adds its losses and norm. False if a
  /// pool is stopping.
  bool Await(Stepping& stepping, UpdateReport& report);
  bool AddTo(UpdateReport& report, const Side& side);
  /// Leaves the gradients of networks in their first accumulators.
  void ComputeGradients(const Source& source, const Minibatch& minibatch,
                        const std::vector<Side*>& sides);
  void AccumulateSlice(Side& side, const Source& source, const Chunks& chunks,
                       const LossSettings& settings, int accumulator, int worker);
  /// Leaves each network's sum in its first accumulator.
  void SumAccumulators(const std::vector<Side*>& sides, int slices);
  /// Adds what the other ranks have of a gradient and beside it.
  void AddOtherRanks(Side& side);
  /// Clips and takes a network's step, unless a pool is stopping.
  void Step(Side& side, const LearningRates& learning_rates);
  void RequireSane(const Side& side);
  /// The first shard whose losses are not finite, for people; empty if there is none.
  std::string FirstBrokenShard(const Side& side);

  PpoConfig config_;
  std::uint64_t seed_;
  bool tanh_mean_;
  int tile_chunks_;
  WorkerPool& pool_;
  Ranks& ranks_;
  ShardRange shards_;                                ///< of the rollout under way
  std::array<Side, 2> sides_;                        ///< actor, critic
  std::vector<std::shared_ptr<Gathered>> gathered_;  ///< one per worker
  double handling_weight_ = 1;                       ///< of the update under way
  double gradient_seconds_ = 0;                      ///< of the update so far
  bool exploded_ = false;
};

}  // namespace skein
