// SPDX-License-Identifier: Apache-2.0
// Compiled for AMX_BF16: see simd/bfloat16_vectors.h.

#include <immintrin.h>

#include "simd/bfloat16_peak.h"
#include "simd/product_kernels.h"

namespace skein::simd {

double MultiplyAddTiles(std::int64_t rounds, float* sink) {
  const ProductKernels kernels = NativeTileKernels(false);
  kernels.begin(16);
  // Four independent sums of two tiles and two, as products have.
  _tile_zero(0);
  _tile_zero(1);
  _tile_zero(2);
  _tile_zero(3);
  _tile_zero(4);
  _tile_zero(5);
  _tile_zero(6);
  _tile_zero(7);
  for (std::int64_t round = 0; round < rounds; ++round) {
    _tile_dpbf16ps(0, 4, 6);
    _tile_dpbf16ps(1, 4, 7);
    _tile_dpbf16ps(2, 5, 6);
    _tile_dpbf16ps(3, 5, 7);
  }
  alignas(64) float sums[16 * 16];
  _tile_stored(0, sums, 64);
  asm volatile("" ::: "memory");
  *sink = sums[0];
  kernels.end();
  constexpr double kTiles = 4, kSums = 16 * 16, kElements = 32, kOperations = 2;
  return static_cast<double>(rounds) * kTiles * kSums * kElements * kOperations;
}

}  // namespace skein::simd
