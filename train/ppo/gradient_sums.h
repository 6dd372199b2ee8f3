// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/aligned_vector.h"

namespace skein {

/// Elements that one task sums over the accumulators of a minibatch: the sums stay in the
/// first-level cache.
inline constexpr std::int64_t kSumBlock = 4096;

/// Leaves the sum of the elements [begin, end) of all accumulators in the first. They are
/// [shard][slice], `slices` of each shard: a shard's are added up in their order, shards by the
/// tree of SumByTree (train/ppo/shards.h). Rounds alike on every target.
void SumGradients(std::int64_t begin, std::int64_t end, int slices,
                  std::vector<AlignedVector<float>>& accumulators);

}  // namespace skein
