// Lookups in tables small enough for registers.

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
