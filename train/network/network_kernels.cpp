// SPDX-License-Identifier: Apache-2.0
#include "train/network/network_kernels.h"

#include <algorithm>
#include <cmath>

#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "train/network/network_kernels.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/math-inl.h"
#include "simd/transpose-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

HWY_INLINE float Sum(V v) {
  const FloatTag d;
  return hn::GetLane(hn::SumOfLanes(d, v));
}

/// 1 / (1 + exp(-x)); Exp limits its argument where the result is 0 or 1 to float32.
HWY_INLINE V Sigmoid(V x) {
  const FloatTag d;
  return Reciprocal(d, hn::Add(hn::Set(d, 1.0f), Exp(d, hn::Neg(x))));
}

HWY_INLINE V Tanh(V x) {
  const FloatTag d;
  const V two = hn::Set(d, 2.0f);
  return hn::MulSub(two, Sigmoid(hn::Mul(two, x)), hn::Set(d, 1.0f));
}

/// `v` with zeros in lanes that lie behind the columns, where it holds the columns from `j` on.
template <bool kPadded>
HWY_INLINE V WithinColumns(int columns, int j, V v) {
  if constexpr (!kPadded) return v;
  const FloatTag d;
  const int left = columns - j;
  return hn::IfThenElseZero(hn::FirstN(d, static_cast<std::size_t>(left > 0 ? left : 0)), v);
}

/// Calls visit(j) for columns [j, j + kLanes) until all `columns`, kLanes at least, are visited;
/// the last ones overlap those before.
template <typename Visit>
HWY_INLINE void ForEachVector(int columns, const Visit& visit) {
  int j = 0;
  for (; j + kLanes <= columns; j += kLanes) visit(j);
  if (j < columns) visit(columns - kLanes);
}

/// The sum over the columns, in their order, of term(x), x a column of `rows` rows, at most kLanes.
template <typename Term>
HWY_INLINE V SumOfColumns(int rows, int columns, const float* in, const Term& term) {
  const FloatTag d;
  V sum = hn::Zero(d);
  int summed = 0;
  ForEachVector(columns, [&](int j) HWY_ATTR {
    V square[kLanes];
    for (int i = 0; i < kLanes; ++i) {
      square[i] = hn::LoadU(d, in + std::min(i, rows - 1) * columns + j);
    }
    Transpose(d, square);
    for (int k = summed - j; k < kLanes; ++k) sum = hn::Add(sum, term(square[k]));
    summed = j + kLanes;
  });
  return sum;
}

/// Rows side by side, in lanes: each row's sums run along it.
void NormaliseRowsTogether(int rows, int columns, const float* in, float* out) {
  const FloatTag d;
  const std::int64_t stride = RowStride(columns);
  const V count = hn::Set(d, static_cast<float>(columns));
  const V means = hn::Div(SumOfColumns(rows, columns, in, [](V x) HWY_ATTR { return x; }), count);
  const V squares = SumOfColumns(rows, columns, in, [means](V x) HWY_ATTR {
    const V deviation = hn::Sub(x, means);
    return hn::Mul(deviation, deviation);
  });
  const V variances = hn::Add(hn::Div(squares, count), hn::Set(d, kLayerNormEpsilon));
  HWY_ALIGN float mean[kLanes], inverse_std[kLanes];
  hn::Store(means, d, mean);
  hn::Store(hn::Div(hn::Set(d, 1.0f), hn::Sqrt(variances)), d, inverse_std);
  for (int i = 0; i < rows; ++i) {
    const V row_mean = hn::Set(d, mean[i]), row_inverse_std = hn::Set(d, inverse_std[i]);
    ForEachVector(columns, [&](int j) HWY_ATTR {
      const V deviation = hn::Sub(hn::LoadU(d, in + i * columns + j), row_mean);
      hn::StoreU(hn::Mul(deviation, row_inverse_std), d, out + i * stride + j);
    });
  }
}

void NormaliseRow(int columns, const float* in, float* out) {
  float sum = 0, squares = 0;
  for (int j = 0; j < columns; ++j) sum += in[j];
  const float mean = sum / static_cast<float>(columns);
  for (int j = 0; j < columns; ++j) squares += (in[j] - mean) * (in[j] - mean);
  const float variance = squares / static_cast<float>(columns);
  const float inverse_std = 1.0f / std::sqrt(variance + kLayerNormEpsilon);
  for (int j = 0; j < columns; ++j) out[j] = (in[j] - mean) * inverse_std;
}

void NormaliseRowsKernel(std::int64_t rows, int columns, const float* in, float* out) {
  const std::int64_t stride = RowStride(columns);
  if (columns < kLanes) {
    for (std::int64_t i = 0; i < rows; ++i)
      NormaliseRow(columns, in + i * columns, out + i * stride);
    return;
  }
  for (std::int64_t i = 0; i < rows; i += kLanes) {
    NormaliseRowsTogether(static_cast<int>(std::min<std::int64_t>(kLanes, rows - i)), columns,
                          in + i * columns, out + i * stride);
  }
}

/// Rows that are normalised together: their sums, chains of dependent additions, run side by side.
constexpr int kRowsTogether = 8, kRowsBackTogether = 4;

/// Normalises the kRows rows from `first` on, with kRelu their rectified values. A row's sums run
/// in one order, however many rows there are.
template <int kRows, bool kRelu, bool kPadded>
HWY_INLINE void NormaliseTogether(std::int64_t first, int columns, const float* in, float* out,
                                  float* inverse_std, float* zero_level) {
  const FloatTag d;
  const int lanes = static_cast<int>(hn::Lanes(d)), width = PaddedWidth(columns);
  const std::int64_t stride = RowStride(columns);
  in += first * stride;
  out += first * stride;
  inverse_std += first;
  V sum[kRows], squares[kRows];
  for (int i = 0; i < kRows; ++i) sum[i] = squares[i] = hn::Zero(d);
  for (int j = 0; j < width; j += lanes) {
    for (int i = 0; i < kRows; ++i) {
      V x = hn::LoadU(d, in + i * stride + j);
      if constexpr (kRelu) {
        // Unlike a maximum with zero, this keeps not-a-number on every target.
        x = hn::IfThenZeroElse(hn::Lt(x, hn::Zero(d)), x);
        hn::StoreU(x, d, out + i * stride + j);
      } else {
        hwy::Prefetch(out + (i + kRows) * stride + j);  // of the next rows
      }
      sum[i] = hn::Add(sum[i], x);
    }
  }
  const float* const values = kRelu ? out : in;
  const auto deviation = [&](int i, int j, V mean) HWY_ATTR {
    return WithinColumns<kPadded>(columns, j, hn::Sub(hn::LoadU(d, values + i * stride + j), mean));
  };
  float mean[kRows];
  for (int i = 0; i < kRows; ++i) mean[i] = Sum(sum[i]) / static_cast<float>(columns);
  for (int j = 0; j < width; j += lanes) {
    for (int i = 0; i < kRows; ++i) {
      const V x = deviation(i, j, hn::Set(d, mean[i]));
      squares[i] = hn::MulAdd(x, x, squares[i]);
    }
  }
  for (int i = 0; i < kRows; ++i) {
    const float variance = Sum(squares[i]) / static_cast<float>(columns);
    inverse_std[i] = 1.0f / std::sqrt(variance + kLayerNormEpsilon);
    if constexpr (kRelu) zero_level[first + i] = -mean[i] * inverse_std[i];
  }
  for (int j = 0; j < width; j += lanes) {
    for (int i = 0; i < kRows; ++i) {
      const V x = deviation(i, j, hn::Set(d, mean[i]));
      hn::StoreU(hn::Mul(x, hn::Set(d, inverse_std[i])), d, out + i * stride + j);
    }
  }
}

template <bool kRelu, bool kPadded>
void NormaliseAll(std::int64_t rows, int columns, const float* in, float* out, float* inverse_std,
                  float* zero_level) {
  std::int64_t i = 0;
  for (; i + kRowsTogether <= rows; i += kRowsTogether) {
    NormaliseTogether<kRowsTogether, kRelu, kPadded>(i, columns, in, out, inverse_std, zero_level);
  }
  for (; i < rows; ++i) {
    NormaliseTogether<1, kRelu, kPadded>(i, columns, in, out, inverse_std, zero_level);
  }
}

void ReluNormaliseKernel(std::int64_t rows, int columns, float* values, float* inverse_std,
                         float* zero_level) {
  const auto kernel =
      PaddedWidth(columns) == columns ? NormaliseAll<true, false> : NormaliseAll<true, true>;
  kernel(rows, columns, values, values, inverse_std, zero_level);
}

void NormaliseWithStdKernel(std::int64_t rows, int columns, const float* in, float* out,
                            float* inverse_std) {
  const auto kernel =
      PaddedWidth(columns) == columns ? NormaliseAll<false, false> : NormaliseAll<false, true>;
  kernel(rows, columns, in, out, inverse_std, nullptr);
}

/// The gradient through NormaliseTogether: `gradient` with respect to the normalised values becomes
/// the one with respect to the values, of which with kRelu the column sums are added to
/// `bias_gradient`, row by row.
template <int kRows, bool kRelu, bool kPadded>
HWY_INLINE void NormaliseBackwardTogether(std::int64_t first, int columns, const float* normalised,
                                          const float* inverse_std, const float* zero_level,
                                          float* gradient, float* bias_gradient) {
  const FloatTag d;
  const int lanes = static_cast<int>(hn::Lanes(d)), width = PaddedWidth(columns);
  const std::int64_t stride = RowStride(columns);
  normalised += first * stride;
  gradient += first * stride;
  // LayerNorm's gradient subtracts the means of the gradient, and of gradient times normalised.
  V sum[kRows], projection[kRows];
  for (int i = 0; i < kRows; ++i) sum[i] = projection[i] = hn::Zero(d);
  for (int j = 0; j < width; j += lanes) {
    for (int i = 0; i < kRows; ++i) {
      const V g = hn::LoadU(d, gradient + i * stride + j);
      sum[i] = hn::Add(sum[i], g);
      projection[i] = hn::MulAdd(g, hn::LoadU(d, normalised + i * stride + j), projection[i]);
    }
  }
  for (int i = 0; i < kRows; ++i) {
    sum[i] = hn::Set(d, Sum(sum[i]) / static_cast<float>(columns));
    projection[i] = hn::Set(d, Sum(projection[i]) / static_cast<float>(columns));
  }
  for (int j = 0; j < width; j += lanes) {
    V bias = hn::Zero(d);
    if constexpr (kRelu) bias = hn::LoadU(d, bias_gradient + j);
    for (int i = 0; i < kRows; ++i) {
      const V x = hn::LoadU(d, normalised + i * stride + j);
      const V g = hn::LoadU(d, gradient + i * stride + j);
      const V centred = hn::NegMulAdd(x, projection[i], hn::Sub(g, sum[i]));
      V result = hn::Mul(hn::Set(d, inverse_std[first + i]), centred);
      if constexpr (kRelu) {
        const V zero = hn::Set(d, zero_level[first + i]);
        result = hn::IfThenElseZero(hn::Gt(x, zero), result);
      }
      result = WithinColumns<kPadded>(columns, j, result);
      hn::StoreU(result, d, gradient + i * stride + j);
      if constexpr (kRelu) bias = hn::Add(bias, result);
    }
    if constexpr (kRelu) hn::StoreU(bias, d, bias_gradient + j);
  }
}

template <bool kRelu, bool kPadded>
void NormaliseBackwardAll(std::int64_t rows, int columns, const float* normalised,
                          const float* inverse_std, const float* zero_level, float* gradient,
                          float* bias_gradient) {
  std::int64_t i = 0;
  for (; i + kRowsBackTogether <= rows; i += kRowsBackTogether) {
    NormaliseBackwardTogether<kRowsBackTogether, kRelu, kPadded>(
        i, columns, normalised, inverse_std, zero_level, gradient, bias_gradient);
  }
  for (; i < rows; ++i) {
    NormaliseBackwardTogether<1, kRelu, kPadded>(i, columns, normalised, inverse_std, zero_level,
                                                 gradient, bias_gradient);
  }
}

void ReluNormaliseBackwardKernel(std::int64_t rows, int columns, const float* normalised,
                                 const float* inverse_std, const float* zero_level, float* gradient,
                                 float* bias_gradient) {
  const auto kernel = PaddedWidth(columns) == columns ? NormaliseBackwardAll<true, false>
                                                      : NormaliseBackwardAll<true, true>;
  kernel(rows, columns, normalised, inverse_std, zero_level, gradient, bias_gradient);
}

void NormaliseBackwardKernel(std::int64_t rows, int columns, const float* normalised,
                             const float* inverse_std, float* gradient) {
  const auto kernel = PaddedWidth(columns) == columns ? NormaliseBackwardAll<false, false>
                                                      : NormaliseBackwardAll<false, true>;
  kernel(rows, columns, normalised, inverse_std, nullptr, gradient, nullptr);
}

void MaskRowsKernel(std::int64_t rows, int columns, const float* not_done, float* values) {
  const FloatTag d;
  const int lanes = static_cast<int>(hn::Lanes(d)), width = PaddedWidth(columns);
  const std::int64_t stride = RowStride(columns);
  for (std::int64_t i = 0; i < rows; ++i) {
    if (not_done[i] == 1) continue;
    const V factor = hn::Set(d, not_done[i]);
    for (std::int64_t j = i * stride; j < i * stride + width; j += lanes) {
      hn::StoreU(hn::Mul(factor, hn::LoadU(d, values + j)), d, values + j);
    }
  }
}

void GruStepKernel(std::int64_t rows, int size, const float* previous, float* gates,
                   std::int64_t stride, float* next) {
  const FloatTag d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const std::int64_t row_stride = RowStride(size);
  for (std::int64_t i = 0; i < rows; ++i) {
    float* const gate_n = gates + i * stride;
    float* const gate_r = gate_n + size;
    float* const gate_z = gate_r + size;
    const float* const gate_q = gate_z + size;
    // The long chains of the new gate begin where those of its reset gate have ended: in loops of
    // their own they run side by side.
    for (int j = 0; j < 2 * size; j += lanes) {
      hn::StoreU(Sigmoid(hn::LoadU(d, gate_r + j)), d, gate_r + j);  // r, and z behind it
    }
    for (int j = 0; j < size; j += lanes) {
      const V r = hn::LoadU(d, gate_r + j), z = hn::LoadU(d, gate_z + j);
      const V n = Tanh(hn::MulAdd(r, hn::LoadU(d, gate_q + j), hn::LoadU(d, gate_n + j)));
      const V h = hn::LoadU(d, previous + i * row_stride + j);
      hn::StoreU(n, d, gate_n + j);
      hn::StoreU(hn::MulAdd(z, hn::Sub(h, n), n), d, next + i * row_stride + j);
    }
  }
}

HWY_INLINE void AddTo(V value, float* sum) {
  const FloatTag d;
  hn::StoreU(hn::Add(hn::LoadU(d, sum), value), d, sum);
}

template <bool kLater>
void GruStepBackwardAll(std::int64_t rows, int size, const float* previous, float* gates,
                        std::int64_t stride, const LaterStep& later, float* state_gradient,
                        float* gate_sums) {
  const FloatTag d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const V one = hn::Set(d, 1.0f);
  const std::int64_t row_stride = RowStride(size);
  for (std::int64_t i = 0; i < rows; ++i) {
    float* const gate_n = gates + i * stride;
    float* const gate_r = gate_n + size;
    float* const gate_z = gate_r + size;
    float* const gate_q = gate_z + size;
    for (int j = 0; j < size; j += lanes) {
      const V n = hn::LoadU(d, gate_n + j), r = hn::LoadU(d, gate_r + j);
      const V z = hn::LoadU(d, gate_z + j), q = hn::LoadU(d, gate_q + j);
      V g = hn::LoadU(d, state_gradient + i * row_stride + j);
      if constexpr (kLater) {
        g = hn::MulAdd(hn::Set(d, later.not_done[i]),
                       hn::LoadU(d, later.gradient + i * row_stride + j), g);
      }
      const V h = hn::LoadU(d, previous + i * row_stride + j);
      const V g_new = hn::Mul(g, hn::Sub(one, z));
      const V g_old = hn::Mul(g, z);
      const V dz = hn::Mul(hn::Mul(g_new, z), hn::Sub(h, n));
      const V dn = hn::Mul(g_new, hn::NegMulAdd(n, n, one));
      const V dq = hn::Mul(dn, r);
      const V dr = hn::Mul(hn::Mul(dq, q), hn::Sub(one, r));
      hn::StoreU(dn, d, gate_n + j);
      hn::StoreU(dr, d, gate_r + j);
      hn::StoreU(dz, d, gate_z + j);
      hn::StoreU(dq, d, gate_q + j);
      hn::StoreU(g_old, d, state_gradient + i * row_stride + j);
      AddTo(dn, gate_sums + j);
      AddTo(dr, gate_sums + size + j);
      AddTo(dz, gate_sums + 2 * size + j);
      AddTo(dq, gate_sums + 3 * size + j);
    }
  }
}

void GruStepBackwardKernel(std::int64_t rows, int size, const float* previous, float* gates,
                           std::int64_t stride, const LaterStep& later, float* state_gradient,
                           float* gate_sums) {
  const auto kernel =
      later.gradient == nullptr ? GruStepBackwardAll<false> : GruStepBackwardAll<true>;
  kernel(rows, size, previous, gates, stride, later, state_gradient, gate_sums);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(NormaliseRowsKernel);
HWY_EXPORT(ReluNormaliseKernel);
HWY_EXPORT(ReluNormaliseBackwardKernel);
HWY_EXPORT(NormaliseWithStdKernel);
HWY_EXPORT(NormaliseBackwardKernel);
HWY_EXPORT(MaskRowsKernel);
HWY_EXPORT(GruStepKernel);
HWY_EXPORT(GruStepBackwardKernel);

void NormaliseRows(std::int64_t rows, int columns, const float* in, float* out) {
  SKEIN_DISPATCH(NormaliseRowsKernel)(rows, columns, in, out);
}

void ReluNormalise(std::int64_t rows, int columns, float* values, float* inverse_std,
                   float* zero_level) {
  SKEIN_DISPATCH(ReluNormaliseKernel)(rows, columns, values, inverse_std, zero_level);
}

void ReluNormaliseBackward(std::int64_t rows, int columns, const float* normalised,
                           const float* inverse_std, const float* zero_level, float* gradient,
                           float* bias_gradient) {
  SKEIN_DISPATCH(ReluNormaliseBackwardKernel)
  (rows, columns, normalised, inverse_std, zero_level, gradient, bias_gradient);
}

void NormaliseWithStd(std::int64_t rows, int columns, const float* in, float* out,
                      float* inverse_std) {
  SKEIN_DISPATCH(NormaliseWithStdKernel)(rows, columns, in, out, inverse_std);
}

void NormaliseBackward(std::int64_t rows, int columns, const float* normalised,
                       const float* inverse_std, float* gradient) {
  SKEIN_DISPATCH(NormaliseBackwardKernel)(rows, columns, normalised, inverse_std, gradient);
}

void MaskRows(std::int64_t rows, int columns, const float* not_done, float* values) {
  SKEIN_DISPATCH(MaskRowsKernel)(rows, columns, not_done, values);
}

void GruStep(std::int64_t rows, int size, const float* previous, float* gates, std::int64_t stride,
             float* next) {
  SKEIN_DISPATCH(GruStepKernel)(rows, size, previous, gates, stride, next);
}

void GruStepBackward(std::int64_t rows, int size, const float* previous, float* gates,
                     std::int64_t stride, const LaterStep& later, float* state_gradient,
                     float* gate_sums) {
  SKEIN_DISPATCH(GruStepBackwardKernel)
  (rows, size, previous, gates, stride, later, state_gradient, gate_sums);
}

void AddColumnSums(std::int64_t rows, int columns, const float* in, std::int64_t stride,
                   float* sums) {
  for (std::int64_t i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) sums[j] += in[i * stride + j];
  }
}

}  // namespace skein
#endif  // HWY_ONCE
