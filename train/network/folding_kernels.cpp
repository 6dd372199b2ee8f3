// SPDX-License-Identifier: Apache-2.0
#include "train/network/folding_kernels.h"

#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "train/network/folding_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/transpose-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

#if HWY_TARGET != HWY_SCALAR
/// FoldRows for kLanes rows from `first` on.
HWY_INLINE void FoldVector(int first, int columns, const FoldedRows& rows) {
  const FloatTag d;
  const hn::Half<FloatTag> half;
  const hn::Repartition<double, FloatTag> wide;
  const float* const weight = rows.weight + static_cast<std::int64_t>(first) * columns;
  float* const folded = rows.folded_weight + first * rows.stride;
  const V bias = hn::LoadU(d, rows.bias + first);
  auto low = hn::PromoteTo(wide, hn::LowerHalf(half, bias));
  auto high = hn::PromoteTo(wide, hn::UpperHalf(half, bias));
  // Products of two float32 are exact in float64: fused or not, the sums round alike.
  const auto add = [&](V column, float factor) HWY_ATTR {
    const auto beta = hn::Set(wide, static_cast<double>(factor));
    low = hn::MulAdd(hn::PromoteTo(wide, hn::LowerHalf(half, column)), beta, low);
    high = hn::MulAdd(hn::PromoteTo(wide, hn::UpperHalf(half, column)), beta, high);
  };
  int j = 0;
  for (; j + kLanes <= columns; j += kLanes) {
    const V gamma = hn::LoadU(d, rows.gamma + j);
    V square[kLanes];
    for (int i = 0; i < kLanes; ++i) {
      square[i] = hn::LoadU(d, weight + i * columns + j);
      hn::StoreU(hn::Mul(square[i], gamma), d, folded + i * rows.stride + j);
    }
    Transpose(d, square);
    for (int k = 0; k < kLanes; ++k) add(square[k], rows.beta[j + k]);
  }
  for (; j < columns; ++j) {
    HWY_ALIGN float column[kLanes];
    for (int i = 0; i < kLanes; ++i) {
      column[i] = weight[i * columns + j];
      folded[i * rows.stride + j] = column[i] * rows.gamma[j];
    }
    add(hn::Load(d, column), rows.beta[j]);
  }
  const V sums = hn::Combine(d, hn::DemoteTo(half, high), hn::DemoteTo(half, low));
  hn::StoreU(sums, d, rows.bias + first);
}
#endif

void FoldRowsKernel(int count, int columns, const FoldedRows& rows) {
  int i = 0;
#if HWY_TARGET != HWY_SCALAR
  for (; i + kLanes <= count; i += kLanes) FoldVector(i, columns, rows);
#endif
  for (; i < count; ++i) {
    const float* const weight = rows.weight + static_cast<std::int64_t>(i) * columns;
    double sum = rows.bias[i];
    for (int j = 0; j < columns; ++j) {
      rows.folded_weight[i * rows.stride + j] = weight[j] * rows.gamma[j];
      sum += static_cast<double>(weight[j]) * rows.beta[j];
    }
    rows.bias[i] = static_cast<float>(sum);
  }
}

void UnfoldRowKernel(int columns, const UnfoldedRow& row) {
  const hn::ScalableTag<double> wide;
  const hn::Rebind<float, hn::ScalableTag<double>> narrow;
  const int lanes = static_cast<int>(hn::Lanes(wide));
  const auto g = hn::Set(narrow, row.bias_gradient);
  const auto wide_g = hn::PromoteTo(wide, g);
  int j = 0;
  for (; j + lanes <= columns; j += lanes) {
    const auto folded = hn::LoadU(narrow, row.folded_gradient + j);
    const auto weight = hn::PromoteTo(wide, hn::LoadU(narrow, row.weight + j));
    const auto from_weight = hn::Mul(folded, hn::LoadU(narrow, row.gamma + j));
    const auto from_bias = hn::Mul(g, hn::LoadU(narrow, row.beta + j));
    hn::StoreU(hn::Add(from_weight, from_bias), narrow, row.weight_gradient + j);
    const auto product = hn::Mul(weight, hn::PromoteTo(wide, folded));
    hn::StoreU(hn::Add(hn::LoadU(wide, row.gamma_gradient + j), product), wide,
               row.gamma_gradient + j);
    hn::StoreU(hn::Add(hn::LoadU(wide, row.beta_gradient + j), hn::Mul(weight, wide_g)), wide,
               row.beta_gradient + j);
  }
  for (; j < columns; ++j) {
    const float folded = row.folded_gradient[j];
    row.weight_gradient[j] = folded * row.gamma[j] + row.bias_gradient * row.beta[j];
    row.gamma_gradient[j] += static_cast<double>(row.weight[j]) * folded;
    row.beta_gradient[j] += static_cast<double>(row.weight[j]) * row.bias_gradient;
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(FoldRowsKernel);
HWY_EXPORT(UnfoldRowKernel);

void FoldRows(int count, int columns, const FoldedRows& rows) {
  SKEIN_DISPATCH(FoldRowsKernel)(count, columns, rows);
}

void UnfoldRow(int columns, const UnfoldedRow& row) {
  SKEIN_DISPATCH(UnfoldRowKernel)(columns, row);
}

}  // namespace skein
#endif  // HWY_ONCE
