// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace skein {

/// A row-major matrix in memory owned by others: element (i, j) at data[i * stride + j].
struct MatrixView {
  float* data = nullptr;
  std::int64_t rows = 0, columns = 0;
  std::int64_t stride = 0;
};

enum class Transpose { kNo, kYes };

/// out = op(a) op(b), or out += op(a) op(b) if `accumulate`. LibTorch's float32 product on the
/// calling thread alone. Throws Error if the shapes do not fit.
void MatMul(const MatrixView& a, Transpose transpose_a, const MatrixView& b, Transpose transpose_b,
            bool accumulate, const MatrixView& out);

}  // namespace skein
