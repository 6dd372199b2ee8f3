// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace skein {

/// The aircraft of a training are cut into equal, contiguous shards. Sums over samples are formed
/// within each shard first and then over shards by one fixed binary tree, so that they do not
/// depend on who computes which shards.
struct ShardRange {
  int total = 1;  ///< of the whole training, a power of two (LearnerConfig::shards)
  int first = 0;  ///< the first that is computed here
  int count = 1;  ///< computed here
};

/// Whether `shards` is a power of two that divides `num_aircraft` and leaves every shard a chunk of
/// each minibatch: it has `chunks_per_aircraft` for each of its aircraft.
bool AreShardsPossible(int shards, int num_aircraft, int chunks_per_aircraft, int minibatches);

/// Throws Error, which names the values that would do, unless they are possible.
void ValidateShards(int shards, int num_aircraft, int chunks_per_aircraft, int minibatches);

/// Several sums that are formed at once.
template <std::size_t kCount>
using Sums = std::array<double, kCount>;

template <std::size_t kCount>
Sums<kCount>& operator+=(Sums<kCount>& sums, const Sums<kCount>& more) {
  for (std::size_t i = 0; i < kCount; ++i) sums[i] += more[i];
  return sums;
}

/// The sum of `parts`, a power of two of them: neighbours first (0 + 1, 2 + 3, ...), then pairs of
/// pairs. 2^k parts that begin at a multiple of 2^k may be summed on their own, by the same tree,
/// and their sum takes their place.
template <typename Value>
Value SumByTree(std::vector<Value> parts) {
  for (std::size_t width = parts.size(); width > 1; width /= 2) {
    for (std::size_t i = 0; 2 * i < width; ++i) {
      parts[i] = parts[2 * i];
      parts[i] += parts[2 * i + 1];
    }
  }
  return parts[0];
}

}  // namespace skein
