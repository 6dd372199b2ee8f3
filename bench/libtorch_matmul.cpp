// SPDX-License-Identifier: Apache-2.0
#include "bench/libtorch_matmul.h"

#include <ATen/ATen.h>
#include <c10/core/InferenceMode.h>

#include <string>

#include "base/error.h"

namespace skein {
namespace {

at::Tensor AsTensor(const MatrixView& view, Transpose transpose) {
  const at::Tensor tensor =
      at::from_blob(view.data, {view.rows, view.columns}, {view.stride, 1}, at::kFloat);
  return transpose == Transpose::kYes ? tensor.t() : tensor;
}

std::string ShapeOf(const at::Tensor& tensor) {
  return std::to_string(tensor.size(0)) + " x " + std::to_string(tensor.size(1));
}

}  // namespace

void MatMul(const MatrixView& a, Transpose transpose_a, const MatrixView& b, Transpose transpose_b,
            bool accumulate, const MatrixView& out) {
  const c10::InferenceMode no_autograd;
  const at::Tensor left = AsTensor(a, transpose_a);
  const at::Tensor right = AsTensor(b, transpose_b);
  at::Tensor result = AsTensor(out, Transpose::kNo);
  if (left.size(1) != right.size(0) || left.size(0) != out.rows || right.size(1) != out.columns) {
    throw Error("MatMul: shapes do not fit: " + ShapeOf(left) + " times " + ShapeOf(right) +
                " into " + ShapeOf(result));
  }
  if (accumulate) {
    at::addmm_out(result, result, left, right);
  } else {
    at::mm_out(result, left, right);
  }
}

}  // namespace skein
