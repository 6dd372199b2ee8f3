// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace skein {

/// Adam's memory of one flat parameter vector.
struct AdamState {
  std::int64_t step = 0;
  std::vector<float> first_moment, second_moment;
};

/// A flat parameter vector and LibTorch's Adam on it (Kingma and Ba 2015; betas 0.9 and 0.999).
class AdamOptimiser {
 public:
  AdamOptimiser(const std::vector<float>& parameters, double epsilon);
  ~AdamOptimiser();
  AdamOptimiser(AdamOptimiser&&) noexcept;

  std::int64_t size() const;
  float* parameters();
  const float* parameters() const;
  float* gradient();

  void Step(double learning_rate);

  AdamState state() const;
  /// Sizes must be those of the parameters.
  void Restore(const AdamState& state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein
