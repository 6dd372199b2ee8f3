// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace skein {

/// Vectors that TakeAdamStep reads must be padded to a multiple of this, and aligned to as many
/// floats.
inline constexpr std::int64_t kAdamPadding = 16;

/// One step of Adam (Kingma and Ba 2015, Algorithm 1) on all elements of four vectors.
struct AdamStep {
  std::int64_t size = 0;  ///< of each vector, padding included
  float* parameters = nullptr;
  float* first_moment = nullptr;
  float* second_moment = nullptr;
  const float* gradient = nullptr;
  float gradient_scale = 1;
  float beta1 = 0, one_minus_beta1 = 0;
  float beta2 = 0, one_minus_beta2 = 0;
  float root_correction = 0;  ///< sqrt(1 - beta2^t)
  float epsilon = 0;
  float step_size = 0;  ///< learning rate / (1 - beta1^t)
};

/// With g the scaled gradient: m = beta1 m + (1 - beta1) g, v = beta2 v + (1 - beta2) g^2,
/// p -= step_size m / (sqrt(v) / root_correction + epsilon).
void TakeAdamStep(const AdamStep& step);

}  // namespace skein
