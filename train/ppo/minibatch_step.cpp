// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/minibatch_step.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace skein {
namespace {

/// In eight sums side by side: one alone is a chain of dependent additions.
double Norm(const float* values, std::int64_t size) {
  constexpr std::int64_t kSums = 8;
  std::array<double, kSums> squares{};
  const std::int64_t whole = size - size % kSums;
  for (std::int64_t i = 0; i < whole; i += kSums) {
    for (std::int64_t k = 0; k < kSums; ++k) {
      const double value = values[i + k];
      squares[k] += value * value;
    }
  }
  for (std::int64_t i = whole; i < size; ++i) {
    squares[i - whole] += static_cast<double>(values[i]) * values[i];
  }
  return std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0));
}

/// Adds up `count` vectors in their order, in the first.
void SumInOrder(std::int64_t begin, std::int64_t end, AlignedVector<float>* vectors, int count) {
  float* const sums = vectors[0].data();
  int next = 1;
  // Four at a time: a sum is loaded and stored once for all.
  for (; next + 4 <= count; next += 4) {
    const float* const a = vectors[next].data();
    const float* const b = vectors[next + 1].data();
    const float* const c = vectors[next + 2].data();
    const float* const d = vectors[next + 3].data();
    for (std::int64_t i = begin; i < end; ++i) sums[i] = (((sums[i] + a[i]) + b[i]) + c[i]) + d[i];
  }
  for (; next < count; ++next) {
    const float* const a = vectors[next].data();
    for (std::int64_t i = begin; i < end; ++i) sums[i] += a[i];
  }
}

/// Adds up every `stride`-th vector by the tree, in the first.
void SumVectorsByTree(std::int64_t begin, std::int64_t end, std::size_t stride,
                      std::vector<AlignedVector<float>>& vectors) {
  const std::size_t count = vectors.size();
  // Two levels at a time.
  for (; 2 * stride < count; stride *= 4) {
    for (std::size_t first = 0; first < count; first += 4 * stride) {
      float* const sums = vectors[first].data();
      const float* const a = vectors[first + stride].data();
      const float* const b = vectors[first + 2 * stride].data();
      const float* const c = vectors[first + 3 * stride].data();
      for (std::int64_t i = begin; i < end; ++i) sums[i] = (sums[i] + a[i]) + (b[i] + c[i]);
    }
  }
  if (stride >= count) return;
  float* const sums = vectors[0].data();
  const float* const a = vectors[stride].data();
  for (std::int64_t i = begin; i < end; ++i) sums[i] += a[i];
}

}  // namespace

void SumGradients(std::int64_t begin, std::int64_t end, int slices,
                  std::vector<AlignedVector<float>>& accumulators) {
  const auto stride = static_cast<std::size_t>(slices);
  for (std::size_t first = 0; first < accumulators.size(); first += stride) {
    SumInOrder(begin, end, &accumulators[first], slices);
  }
  SumVectorsByTree(begin, end, stride, accumulators);
}

double ClippedStep(double max_norm, double learning_rate, AdamOptimiser& optimiser) {
  const double norm = Norm(optimiser.gradient(), optimiser.size());
  if (!(norm <= kExplodedGradientNorm)) return norm;
  optimiser.Step(learning_rate, norm > max_norm ? static_cast<float>(max_norm / norm) : 1.0f);
  return norm;
}

}  // namespace skein
