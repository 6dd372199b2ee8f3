// SPDX-License-Identifier: Apache-2.0
#include "envs/actions.h"

#include <algorithm>
#include <limits>

#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "envs/actions.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

void TakeActionsKernel(const float* action, Tile tile, float* command, std::size_t command_stride) {
  const FloatTag d;
  const V one = Constant(1), half = Constant(0.5), zero = hn::Zero(d);
  alignas(64) float last_rows[kLanes * kActionSize] = {};
  for (int first = 0; first < tile.count; first += kLanes) {
    const float* rows = action + first * kActionSize;
    if (tile.count - first < kLanes) {
      std::copy(rows, action + tile.count * kActionSize, last_rows);
      rows = last_rows;
    }
    V x[kActionSize];
    hn::LoadInterleaved4(d, rows, x[0], x[1], x[2], x[3]);
    V poison = zero;
    for (int k = 0; k < kActionSize; ++k) {
      poison = hn::MulAdd(zero, x[k], poison);
      V clipped = hn::Min(hn::Max(x[k], hn::Neg(one)), one);
      if (k == 0) clipped = hn::MulAdd(half, clipped, half);
      hn::StoreU(clipped, d, command + static_cast<std::size_t>(k) * command_stride + first);
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

void TakeActions(const float* action, Tile tile, float* command, std::size_t command_stride) {
  SKEIN_DISPATCH(TakeActionsKernel)(action, tile, command, command_stride);
}

}  // namespace skein
#endif
