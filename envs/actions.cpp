// SPDX-License-Identifier: Apache-2.0
#include "envs/actions.h"

#include <algorithm>
#include <limits>

#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/actions.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

void TakeActionsKernel(const float* action, Tile tile, float* pilot, std::size_t pilot_stride) {
  const hn::ScalableTag<float> d;
  using V = hn::Vec<decltype(d)>;
  constexpr int kMaxLanes = 16;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const V one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f), zero = hn::Zero(d);
  alignas(64) float last_rows[kMaxLanes * kActionSize] = {};
  for (int first = 0; first < tile.count; first += lanes) {
    const float* rows = action + first * kActionSize;
    if (tile.count - first < lanes) {
      std::copy(rows, action + tile.count * kActionSize, last_rows);
      rows = last_rows;
    }
    V x[kActionSize];
    hn::LoadInterleaved4(d, rows, x[0], x[1], x[2], x[3]);
    V poison = zero;
    for (int k = 0; k < kActionSize; ++k) {
      poison = hn::MulAdd(zero, x[k], poison);
      V command = hn::Min(hn::Max(x[k], hn::Neg(one)), one);
      if (k == 0) command = hn::MulAdd(half, command, half);
      hn::StoreU(command, d, pilot + static_cast<std::size_t>(k) * pilot_stride + first);
    }
    // Zero, or NaN where any of the four is not finite.
    float* const u = tile[kU] + first;
    hn::StoreU(hn::Add(hn::LoadU(d, u), poison), d, u);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {

HWY_EXPORT(TakeActionsKernel);

void TakeActions(const float* action, Tile tile, float* pilot, std::size_t pilot_stride) {
  SKEIN_DISPATCH(TakeActionsKernel)(action, tile, pilot, pilot_stride);
}

}  // namespace skein
#endif
