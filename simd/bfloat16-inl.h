// SPDX-License-Identifier: Apache-2.0
// Rounding to bfloat16 for kernels (see simd/dispatch.h).

#if defined(SKEIN_SIMD_BFLOAT16_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_SIMD_BFLOAT16_INL_H_
#undef SKEIN_SIMD_BFLOAT16_INL_H_
#else
#define SKEIN_SIMD_BFLOAT16_INL_H_
#endif

#include <hwy/highway.h>

#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

/// simd::RoundToBfloat16 as a float32.
HWY_INLINE V Rounded(V x) {
  const FloatTag d;
  const IntTag di;  // magnitudes: compared as signed integers
  const auto bits = hn::BitCast(di, x);
  const auto magnitude = hn::And(bits, hn::Set(di, 0x7fffffff));
  const auto odd = hn::And(hn::ShiftRight<16>(bits), hn::Set(di, 1));
  const auto nearest = hn::Add(bits, hn::Add(odd, hn::Set(di, 0x7fff)));
  const auto quiet = hn::Or(bits, hn::Set(di, 0x00400000));
  const auto zero = hn::AndNot(hn::Set(di, 0x7fffffff), bits);
  const auto is_nan = hn::Gt(magnitude, hn::Set(di, 0x7f800000));
  const auto is_denormal = hn::Gt(hn::Set(di, 0x00800000), magnitude);
  const auto rounded = hn::IfThenElse(is_denormal, zero, hn::IfThenElse(is_nan, quiet, nearest));
  return hn::BitCast(d, hn::AndNot(hn::Set(di, 0xffff), rounded));
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_SIMD_BFLOAT16_INL_H_
