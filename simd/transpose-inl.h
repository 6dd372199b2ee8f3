// SPDX-License-Identifier: Apache-2.0
// Transposition of a square of float32 held in as many vectors as a vector has lanes.

#if defined(SKEIN_SIMD_TRANSPOSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_SIMD_TRANSPOSE_INL_H_
#undef SKEIN_SIMD_TRANSPOSE_INL_H_
#else
#define SKEIN_SIMD_TRANSPOSE_INL_H_
#endif

#include <hwy/highway.h>

#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR
/// Transposes the 4 x 4 squares within the 128-bit blocks of rows[0..3].
template <class D, class V = hn::Vec<D>>
HWY_INLINE void TransposeBlocks(D d, V* rows) {
  const hn::Repartition<double, D> wide;
  const auto a = hn::BitCast(wide, hn::InterleaveLower(d, rows[0], rows[1]));
  const auto b = hn::BitCast(wide, hn::InterleaveUpper(d, rows[0], rows[1]));
  const auto c = hn::BitCast(wide, hn::InterleaveLower(d, rows[2], rows[3]));
  const auto e = hn::BitCast(wide, hn::InterleaveUpper(d, rows[2], rows[3]));
  rows[0] = hn::BitCast(d, hn::InterleaveLower(wide, a, c));
  rows[1] = hn::BitCast(d, hn::InterleaveUpper(wide, a, c));
  rows[2] = hn::BitCast(d, hn::InterleaveLower(wide, b, e));
  rows[3] = hn::BitCast(d, hn::InterleaveUpper(wide, b, e));
}
#endif

#if HWY_TARGET == HWY_AVX3
/// The even (odd) 128-bit blocks of `a`, then those of `b`. Highway 1.0.3 has no such shuffle.
template <class V>
HWY_INLINE V EvenBlocks(V a, V b) {
  return V{_mm512_shuffle_f32x4(a.raw, b.raw, 0x88)};
}
template <class V>
HWY_INLINE V OddBlocks(V a, V b) {
  return V{_mm512_shuffle_f32x4(a.raw, b.raw, 0xdd)};
}
#endif

/// Lane j of rows[i] and lane i of rows[j] change places, i and j from 0 to Lanes(d) - 1. Made for
/// rows in registers; results that are not used cost little.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void Transpose(D d, V* rows) {
#if HWY_TARGET == HWY_AVX3
  for (int i = 0; i < 16; i += 4) TransposeBlocks(d, rows + i);
  for (int j = 0; j < 4; ++j) {
    const V even_low = EvenBlocks(rows[j], rows[4 + j]);
    const V even_high = EvenBlocks(rows[8 + j], rows[12 + j]);
    const V odd_low = OddBlocks(rows[j], rows[4 + j]);
    const V odd_high = OddBlocks(rows[8 + j], rows[12 + j]);
    rows[j] = EvenBlocks(even_low, even_high);
    rows[4 + j] = EvenBlocks(odd_low, odd_high);
    rows[8 + j] = OddBlocks(even_low, even_high);
    rows[12 + j] = OddBlocks(odd_low, odd_high);
  }
#elif HWY_TARGET == HWY_AVX2
  TransposeBlocks(d, rows);
  TransposeBlocks(d, rows + 4);
  for (int j = 0; j < 4; ++j) {
    const V low = hn::ConcatLowerLower(d, rows[4 + j], rows[j]);
    rows[4 + j] = hn::ConcatUpperUpper(d, rows[4 + j], rows[j]);
    rows[j] = low;
  }
#elif HWY_TARGET != HWY_SCALAR
  static_assert(kLanes == 4, "a square of one block");
  TransposeBlocks(d, rows);
#else
  static_cast<void>(d);
  static_cast<void>(rows);
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_SIMD_TRANSPOSE_INL_H_
