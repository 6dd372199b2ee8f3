// Cell numbers, and lookups in tables small enough for registers.

#if defined(SKEIN_SIMD_LOOKUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_SIMD_LOOKUP_INL_H_
#undef SKEIN_SIMD_LOOKUP_INL_H_
#else
#define SKEIN_SIMD_LOOKUP_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

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
#else
  return hn::GatherIndex(d, table, index);
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_SIMD_LOOKUP_INL_H_
