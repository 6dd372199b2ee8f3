// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/aligned_vector.h"
#include "train/ppo/adam.h"

namespace skein {

/// Elements that one task sums over the shards of a minibatch: the sums stay in the first-level
/// cache.
inline constexpr std::int64_t kSumBlock = 4096;

/// No training that goes well comes near: unscaled values of +-200 give norms of thousands.
inline constexpr double kExplodedGradientNorm = 1e8;

/// The sum of all shards' elements [begin, end), added up in the order of the shards, in the first.
void SumShards(std::int64_t begin, std::int64_t end, std::vector<AlignedVector<float>>& shards);

/// Scales the optimiser's gradient down to `max_norm` if it is longer, and takes a step; returns
/// the norm before. Leaves all as it is if that is above kExplodedGradientNorm or not a number.
double ClippedStep(double max_norm, double learning_rate, AdamOptimiser& optimiser);

}  // namespace skein
