// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/clipped_step.h"

#include <array>
#include <cmath>
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

}  // namespace

double ClippedStep(double max_norm, double learning_rate, AdamOptimiser& optimiser) {
  const double norm = Norm(optimiser.gradient(), optimiser.size());
  if (!(norm <= kExplodedGradientNorm)) return norm;
  optimiser.Step(learning_rate, norm > max_norm ? static_cast<float>(max_norm / norm) : 1.0f);
  return norm;
}

}  // namespace skein
