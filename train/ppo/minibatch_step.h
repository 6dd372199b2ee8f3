// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/aligned_vector.h"
#include "train/ppo/adam.h"

namespace skein {

/// Elements that one task sums over the accumulators of a minibatch: the sums stay in the
/// first-level cache.
inline constexpr std::int64_t kSumBlock = 4096;

/// No training that goes well comes near: unscaled values of +-200 give norms of thousands.
inline constexpr double kExplodedGradientNorm = 1e8;

/// Leaves the sum of the elements [begin, end) of all accumulators in the first. They are
/// [shard][slice], `slices` of each shard: a shard's are added up in their order, shards by the
/// tree of SumByTree (train/ppo/shards.h).
void SumGradients(std::int64_t begin, std::int64_t end, int slices,
                  std::vector<AlignedVector<float>>& accumulators);

/// Takes a step by the optimiser's gradient, scaled down to `max_norm` if it is longer, and returns
/// its norm. The gradient stays as it is; all else does, too, if the norm is above
/// kExplodedGradientNorm or not a number.
double ClippedStep(double max_norm, double learning_rate, AdamOptimiser& optimiser);

}  // namespace skein
