// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "simd/matrix_product.h"
#include "train/network/folded_parameters.h"
#include "train/network/precision.h"

namespace skein {

/// One linear layer of a network on rows of samples, forward and backward. Strides are floats
/// between rows. Const functions may run on several threads at once, each with its own workspace.
class LinearLayer {
 public:
  LinearLayer(const FoldedLinear& place, const NetworkPrecision& precision)
      : place_(place), precision_(precision) {}

  /// Widths, and where weight and bias lie in folded vectors.
  const FoldedLinear& place() const { return place_; }

  /// Folds its part of a network's flat vector into `folded`, and packs it while it is in the
  /// cache.
  void SetParameters(const float* parameters, float* folded);

  /// out = W in, plus what was in `out` in its first `accumulated` columns, and `bias` in the
  /// others.
  void Forward(std::int64_t rows, const float* in, std::int64_t in_stride, const float* bias,
               std::int64_t accumulated, float* out, std::int64_t out_stride,
               simd::ProductWorkspace* workspace) const;

  /// input_gradient = W^T output_gradient, plus what was in it if `accumulate`.
  void BackwardToInput(std::int64_t rows, const float* output_gradient, std::int64_t output_stride,
                       bool accumulate, float* input_gradient, std::int64_t input_stride,
                       simd::ProductWorkspace* workspace) const;

  /// Adds the sum over rows of output_gradient in^T to the weight's gradient.
  void BackwardToWeight(std::int64_t rows, const float* in, std::int64_t in_stride,
                        const float* output_gradient, std::int64_t output_stride,
                        float* folded_gradient, simd::ProductWorkspace* workspace) const;

 private:
  FoldedLinear place_;
  NetworkPrecision precision_;
  simd::PackedMatrix forward_, backward_;
};

}  // namespace skein
