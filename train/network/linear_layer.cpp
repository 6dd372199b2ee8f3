// SPDX-License-Identifier: Apache-2.0
#include "train/network/linear_layer.h"

namespace skein {

void LinearLayer::SetParameters(const float* parameters, float* folded) {
  FoldLinear(place_, parameters, folded);
  const float* const weight = folded + place_.weight;
  forward_.Pack(place_.in, place_.out, weight, 1, place_.in, precision_.forward);
  backward_.Pack(place_.out, place_.in, weight, place_.in, 1, precision_.backward);
}

void LinearLayer::Forward(std::int64_t rows, const float* in, std::int64_t in_stride,
                          const float* bias, std::int64_t accumulated, float* out,
                          std::int64_t out_stride, simd::ProductWorkspace* workspace) const {
  simd::Multiply(rows, in, in_stride, forward_, bias, accumulated, out, out_stride, workspace);
}

void LinearLayer::BackwardToInput(std::int64_t rows, const float* output_gradient,
                                  std::int64_t output_stride, bool accumulate,
                                  float* input_gradient, std::int64_t input_stride,
                                  simd::ProductWorkspace* workspace) const {
  simd::Multiply(rows, output_gradient, output_stride, backward_, nullptr,
                 accumulate ? place_.in : 0, input_gradient, input_stride, workspace);
}

void LinearLayer::BackwardToWeight(std::int64_t rows, const float* in, std::int64_t in_stride,
                                   const float* output_gradient, std::int64_t output_stride,
                                   float* folded_gradient,
                                   simd::ProductWorkspace* workspace) const {
  float* const gradient = folded_gradient + place_.weight;
  if (place_.gradient_by_input) {
    simd::AddTransposedProduct(rows, in, in_stride, place_.in, output_gradient, output_stride,
                               place_.out, precision_.backward, gradient, place_.out, workspace);
    return;
  }
  simd::AddTransposedProduct(rows, output_gradient, output_stride, place_.out, in, in_stride,
                             place_.in, precision_.backward, gradient, place_.in, workspace);
}

}  // namespace skein
