// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "train/ppo/rollout.h"

namespace skein {

/// Chunks of one shard, by their numbers in a Rollout: chunk * aircraft + index.
struct Chunks {
  const std::int64_t* first = nullptr;
  int count = 0;
};

/// An epoch's minibatches: the chunks of every shard are shuffled among themselves, keyed by (seed,
/// iteration, epoch, shard), and a minibatch takes the same part of every shard.
class Minibatches {
 public:
  Minibatches(const Rollout& rollout, int minibatches, std::uint64_t seed, std::uint64_t iteration,
              int epoch);

  /// The `index`-th minibatch's chunks of each shard that is computed here: as many of each.
  std::vector<Chunks> At(int index) const;

 private:
  int minibatches_;
  std::vector<std::vector<std::int64_t>> order_;  ///< [shard]
};

}  // namespace skein
