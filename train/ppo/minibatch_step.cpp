// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/minibatch_step.h"

#include <cmath>
#include <cstddef>

namespace skein {
namespace {

double Norm(const float* values, std::int64_t size) {
  double squares = 0;
  for (std::int64_t i = 0; i < size; ++i) squares += static_cast<double>(values[i]) * values[i];
  return std::sqrt(squares);
}

}  // namespace

void SumShards(std::int64_t begin, std::int64_t end, std::vector<AlignedVector<float>>& shards) {
  float* const sums = shards[0].data();
  std::size_t shard = 1;
  // Four at a time: a sum is loaded and stored once for all.
  for (; shard + 4 <= shards.size(); shard += 4) {
    const float* const a = shards[shard].data();
    const float* const b = shards[shard + 1].data();
    const float* const c = shards[shard + 2].data();
    const float* const d = shards[shard + 3].data();
    for (std::int64_t i = begin; i < end; ++i) sums[i] = (((sums[i] + a[i]) + b[i]) + c[i]) + d[i];
  }
  for (; shard < shards.size(); ++shard) {
    const float* const a = shards[shard].data();
    for (std::int64_t i = begin; i < end; ++i) sums[i] += a[i];
  }
}

double ClippedStep(double max_norm, double learning_rate, AdamOptimiser& optimiser) {
  float* const gradient = optimiser.gradient();
  const std::int64_t size = optimiser.size();
  const double norm = Norm(gradient, size);
  if (!(norm <= kExplodedGradientNorm)) return norm;
  if (norm > max_norm) {
    const auto scale = static_cast<float>(max_norm / norm);
    for (std::int64_t i = 0; i < size; ++i) gradient[i] *= scale;
  }
  optimiser.Step(learning_rate);
  return norm;
}

}  // namespace skein
