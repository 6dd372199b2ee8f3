// SPDX-License-Identifier: Apache-2.0
// Compiled for AVX512_BF16: see simd/bfloat16_vectors.h.

#include "simd/bfloat16_peak.h"

#include <immintrin.h>

namespace skein::simd {

double MultiplyAddBfloat16(std::int64_t rounds, float* sink) {
  // As many independent chains as products have; the compiler may not see that they are equal.
  constexpr int kChains = 24;
  __m512 sum[kChains];
#pragma GCC unroll 24
  for (int i = 0; i < kChains; ++i) sum[i] = _mm512_set1_ps(0.1f);
  const __m512i ones = _mm512_set1_epi32(0x3f803f80);
  for (std::int64_t round = 0; round < rounds; ++round) {
#pragma GCC unroll 24
    for (int i = 0; i < kChains; ++i) {
      sum[i] = _mm512_dpbf16_ps(sum[i], (__m512bh)ones, (__m512bh)ones);
      asm volatile("" : "+v"(sum[i]));
    }
  }
#pragma GCC unroll 24
  for (int i = 1; i < kChains; ++i) sum[0] += sum[i];
  *sink = sum[0][0];
  constexpr double kLanes = 16, kPair = 2, kOperations = 2;
  return static_cast<double>(rounds) * kChains * kLanes * kPair * kOperations;
}

}  // namespace skein::simd
