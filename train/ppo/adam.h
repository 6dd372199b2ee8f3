// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/aligned_vector.h"

namespace skein {

/// Adam's memory of one flat parameter vector.
struct AdamState {
  std::int64_t step = 0;
  std::vector<float> first_moment, second_moment;
};

/// Successive parameters that learn at a multiple of the others' rate.
struct RateFactor {
  std::int64_t begin = 0, end = 0;
  double factor = 1;
};

/// A flat parameter vector, its gradient, and Adam on them (Kingma and Ba 2015, "Adam: a method for
/// stochastic optimization", Algorithm 1, with betas 0.9 and 0.999). Bias is corrected as in
/// PyTorch's Adam: epsilon is added to the corrected root. Deterministic, in float32, on the
/// calling thread.
class AdamOptimiser {
 public:
  /// `epsilon` must be positive.
  AdamOptimiser(const std::vector<float>& parameters, double epsilon,
                const RateFactor& rate_factor = {});

  std::int64_t size() const { return size_; }
  float* parameters() { return parameters_.data(); }
  const float* parameters() const { return parameters_.data(); }
  float* gradient() { return gradient_.data(); }

  /// Steps by `gradient_scale` times the gradient, which stays as it is.
  void Step(double learning_rate, float gradient_scale = 1);

  std::vector<float> ParameterVector() const { return {parameters(), parameters() + size_}; }
  /// `parameters` has size() floats.
  void SetParameters(const std::vector<float>& parameters);

  AdamState state() const;
  /// Throws Error unless sizes are those of the parameters.
  void Restore(const AdamState& state);

 private:
  std::int64_t size_ = 0;
  double epsilon_;
  RateFactor rate_factor_;
  std::int64_t step_ = 0;
  // Padded by zeros to whole vectors of every SIMD target; zeros stay zeros.
  AlignedVector<float> parameters_, gradient_, first_moment_, second_moment_;
};

}  // namespace skein
