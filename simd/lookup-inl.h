// SPDX-License-Identifier: Apache-2.0
// Cell numbers, and lookups in tables small enough for registers.

#if defined(SKEIN_SIMD_LOOKUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_SIMD_LOOKUP_INL_H_
#undef SKEIN_SIMD_LOOKUP_INL_H_
#else
#define SKEIN_SIMD_LOOKUP_INL_H_
#endif

#include <hwy/highway.h>

#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
/// The integer part of x for |x| < 2^31; any integer for others, NaN too. hn::ConvertTo spends four
/// more operations on making that integer the nearest one.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Vec<hn::RebindToSigned<D>> TruncateToInt(D /*d*/, V x) {
#if HWY_TARGET == HWY_AVX3
  return {_mm512_cvttps_epi32(x.raw)};
#elif HWY_TARGET == HWY_AVX2
  return {_mm256_cvttps_epi32(x.raw)};
#elif HWY_TARGET == HWY_SSE4
  return {_mm_cvttps_epi32(x.raw)};
#elif HWY_TARGET == HWY_SCALAR
  // C++ leaves it open what a NaN becomes, and may do anything with it.
  return hn::ConvertTo(hn::RebindToSigned<D>(), hn::IfThenElseZero(hn::Eq(x, x), x));
#else
  return hn::ConvertTo(hn::RebindToSigned<D>(), x);
#endif
}

/// table[index] in every lane. `table` has 32 floats, aligned to 64 bytes; indices in [0, 32).
template <class D, class V = hn::Vec<D>, class VI = hn::Vec<hn::RebindToSigned<D>>>
HWY_INLINE V Lookup32(D d, const float* table, VI index) {
#if HWY_TARGET == HWY_AVX3
  // Highway 1.0.3 has no permutation of two tables.
  const V low = hn::Load(d, table);
  const V high = hn::Load(d, table + 16);
  return V{_mm512_permutex2var_ps(low.raw, index.raw, high.raw)};
#elif HWY_TARGET == HWY_AVX2
  // Not a gather: processors with the mitigation of "Downfall" take over a hundred cycles for one.
  // Each permutation goes by the index' low three bits; bits 3 and 4, as signs, choose among them.
  const auto permuted = [&](int first) HWY_ATTR {
    return _mm256_permutevar8x32_ps(hn::Load(d, table + first).raw, index.raw);
  };
  const __m256 bit3 = hn::BitCast(d, hn::ShiftLeft<28>(index)).raw;
  const __m256 bit4 = hn::BitCast(d, hn::ShiftLeft<27>(index)).raw;
  const __m256 low = _mm256_blendv_ps(permuted(0), permuted(8), bit3);
  const __m256 high = _mm256_blendv_ps(permuted(16), permuted(24), bit3);
  return V{_mm256_blendv_ps(low, high, bit4)};
#else
  return hn::GatherIndex(d, table, index);
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_SIMD_LOOKUP_INL_H_
