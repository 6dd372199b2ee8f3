// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <immintrin.h>

#include <cstdint>

// Vectors of pairs of bfloat16, for sources that are compiled for AVX512_BF16 and run only where
// NativeBfloat16() (simd/target.h). Everything is in an anonymous namespace and nothing of the
// standard library is called, so that no function built for that processor can end up in place of
// one that others run, too.

namespace skein::simd {
namespace {

inline constexpr int kLanes = 16;
inline constexpr __mmask16 kAllLanes = 0xffff;

using Word = std::int32_t;  // a pair of bfloat16, the even element in the lower half

inline __mmask16 FirstLanes(std::int64_t count) {
  return count >= kLanes ? kAllLanes : static_cast<__mmask16>((1u << count) - 1);
}

/// Pairs of an even and an odd row's lanes.
inline __m512i Paired(__m512 even, __m512 odd) {
  // Lane by lane, the even row's half of the vector and the odd row's.
  alignas(64) static constexpr std::int16_t kLanesInTurns[2 * kLanes] = {
      0, 16, 1, 17, 2,  18, 3,  19, 4,  20, 5,  21, 6,  22, 7,  23,
      8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31};
  const __m512i halves = (__m512i)_mm512_cvtne2ps_pbh(odd, even);
  return _mm512_maskz_permutexvar_epi16(~__mmask32{0}, _mm512_load_si512(kLanesInTurns), halves);
}

}  // namespace
}  // namespace skein::simd
