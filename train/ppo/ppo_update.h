// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/worker_pool.h"
#include "train/network/backend.h"
#include "train/network/recurrent_network.h"
#include "train/ppo/adam.h"
#include "train/ppo/rollout.h"
#include "train/ppo/train_config.h"

namespace skein {

/// What an update did: means over all minibatches.
struct UpdateReport {
  LossSums losses;
  double actor_gradient_norm = 0, critic_gradient_norm = 0;  ///< before clipping
  double gradient_seconds = 0;  ///< in forward, losses and backward, of all minibatches
};

/// PPO's epochs over a rollout: minibatches of shuffled chunks, each cut into a fixed number of
/// shards whose gradients are summed in a fixed order, so that no bit depends on the threads.
class PpoUpdate {
 public:
  PpoUpdate(const TrainConfig& config, const BackendChoice& backend, const NetworkLayout& actor,
            const NetworkLayout& critic, WorkerPool& pool);

  /// `iteration` keys the shuffles. Throws Error if a loss or a gradient is not finite, or a
  /// gradient's norm exceeds kExplodedGradientNorm (train/ppo/minibatch_step.h); parameters may
  /// then have moved. So they may if the pool is stopping: the update then ends within a tile,
  /// unfinished.
  UpdateReport Run(const Rollout& rollout, const ValueScale& scale, std::uint64_t iteration,
                   double learning_rate, AdamOptimiser& actor, AdamOptimiser& critic);

 private:
  /// A network and its gradient: one accumulator and one sum of losses per shard.
  struct Side {
    std::unique_ptr<RecurrentNetwork> network;
    std::vector<AlignedVector<float>> accumulators;
    std::vector<LossSums> losses;
    double norm = 0;
  };
  struct Gathered;
  struct Advantages {
    double mean = 0, inverse_std = 1;
  };

  void RunShard(Side& side, const Rollout& rollout, const ValueScale& scale,
                const Advantages& advantages, const std::int64_t* chunks, int count,
                const LossSettings& settings, int shard, int worker);
  LossSums Minibatch(const Rollout& rollout, const ValueScale& scale, const Advantages& advantages,
                     const std::int64_t* chunks, int count, double learning_rate,
                     AdamOptimiser& actor, AdamOptimiser& critic);
  Advantages AdvantageScale(const Rollout& rollout) const;

  PpoConfig config_;
  std::uint64_t seed_;
  bool tanh_mean_;
  int tile_chunks_;
  WorkerPool& pool_;
  Side actor_, critic_;
  std::vector<std::shared_ptr<Gathered>> gathered_;  ///< one per worker
  double gradient_seconds_ = 0;                      ///< of the update so far
};

}  // namespace skein
