// SPDX-License-Identifier: Apache-2.0
// Compiled for AVX512_BF16 and run only where NativeBfloat16(): everything is in an anonymous
// namespace and nothing of the standard library is called, so that no function built for that
// processor can end up in place of one that others run, too.

#include <immintrin.h>

#include <cstdint>

#include "simd/product_kernels.h"

namespace skein::simd {
namespace {

constexpr int kLanes = 16;
constexpr __mmask16 kAllLanes = 0xffff;
constexpr int kSums = 24, kPanelVectors = 4;

using Word = std::int32_t;  // a pair of bfloat16, the even element in the lower half

__mmask16 FirstLanes(std::int64_t count) {
  return count >= kLanes ? kAllLanes : static_cast<__mmask16>((1u << count) - 1);
}

/// out = init + A B for kRows rows and kVectors vectors of columns, of which `last` says which
/// lanes of the last one are not padding.
template <int kRows, int kVectors, bool kTransposed>
inline __attribute__((always_inline)) void Tile(const PanelProduct& p, const Word* a,
                                                const float* init, float* out, __mmask16 last) {
  const auto mask = [&](int j) -> __mmask16 { return j + 1 < kVectors ? kAllLanes : last; };
  const char* b = static_cast<const char*>(p.b);
  // One loop, not two: g++ unrolls nested ones too late to keep the sums in registers.
  __m512 sum[kRows * kVectors];
#pragma GCC unroll 64
  for (int t = 0; t < kRows * kVectors; ++t) {
    const int i = t / kVectors, j = t % kVectors;
    sum[t] = _mm512_maskz_loadu_ps(mask(j), init + i * p.init_stride + j * kLanes);
  }
#pragma GCC unroll 2
  for (std::int64_t k = 0; k < p.depth; ++k) {
    __m512i right[kVectors];
#pragma GCC unroll 16
    for (int j = 0; j < kVectors; ++j) right[j] = _mm512_loadu_si512(b + j * sizeof(__m512i));
#pragma GCC unroll 16
    for (int i = 0; i < kRows; ++i) {
      const __m512i left = _mm512_set1_epi32(kTransposed ? a[i] : a[i * p.a_stride]);
#pragma GCC unroll 16
      for (int j = 0; j < kVectors; ++j) {
        __m512& s = sum[i * kVectors + j];
        s = _mm512_dpbf16_ps(s, (__m512bh)left, (__m512bh)right[j]);
      }
    }
    a += kTransposed ? p.a_stride : 1;
    b += kVectors * sizeof(__m512i);
  }
#pragma GCC unroll 64
  for (int t = 0; t < kRows * kVectors; ++t) {
    const int i = t / kVectors, j = t % kVectors;
    _mm512_mask_storeu_ps(out + i * p.out_stride + j * kLanes, mask(j), sum[t]);
  }
}

/// Tiles of kRows rows, as many as fit between `row` and the end; then one tile of the rest.
template <int kRows, int kVectors, bool kTransposed>
void Strips(const PanelProduct& p, std::int64_t row) {
  if constexpr (kRows > 0) {
    const __mmask16 last = FirstLanes(p.columns - (kVectors - 1) * kLanes);
    for (; row + kRows <= p.rows; row += kRows) {
      Tile<kRows, kVectors, kTransposed>(
          p, static_cast<const Word*>(p.a) + row * (kTransposed ? 1 : p.a_stride),
          p.init + row * p.init_stride, p.out + row * p.out_stride, last);
    }
    if (row < p.rows) Strips<kRows - 1, kVectors, kTransposed>(p, row);
  }
}

template <int kVectors>
void MultiplyPanelOf(const PanelProduct& p) {
  if constexpr (kVectors > 0) {
    if (p.vectors != kVectors) return MultiplyPanelOf<kVectors - 1>(p);
    constexpr int kMostRows = 16;  // more are no faster
    constexpr int kRows = kSums / kVectors < kMostRows ? kSums / kVectors : kMostRows;
    if (p.a_transposed) {
      Strips<kRows, kVectors, true>(p, 0);
    } else {
      Strips<kRows, kVectors, false>(p, 0);
    }
  }
}

void MultiplyPanel(const PanelProduct& p) { MultiplyPanelOf<kPanelVectors>(p); }

void RoundRows(const RowBlock& block, std::int64_t words_stride, void* words) {
  for (std::int64_t i = 0; i < block.rows; ++i) {
    const float* const in = block.data + i * block.stride;
    char* const out = static_cast<char*>(words) + i * words_stride * sizeof(Word);
    for (std::int64_t j = 0; j < block.columns; j += 2 * kLanes) {
      const std::int64_t left = block.columns - j;
      const __m512 low = _mm512_maskz_loadu_ps(FirstLanes(left), in + j);
      const __m512 high = left > kLanes
                              ? _mm512_maskz_loadu_ps(FirstLanes(left - kLanes), in + j + kLanes)
                              : _mm512_setzero_ps();
      _mm512_mask_storeu_epi32(out + j / 2 * sizeof(Word), FirstLanes((left + 1) / 2),
                               (__m512i)_mm512_cvtne2ps_pbh(high, low));
    }
  }
}

void PackRows(const RowBlock& block, std::int64_t words_stride, void* words) {
  for (std::int64_t i = 0; i < block.rows; i += 2) {
    const float* const even = block.data + i * block.stride;
    char* const out = static_cast<char*>(words) + i / 2 * words_stride * sizeof(Word);
    for (std::int64_t j = 0; j < block.columns; j += kLanes) {
      const __mmask16 mask = FirstLanes(block.columns - j);
      const __m512 low = _mm512_maskz_loadu_ps(mask, even + j);
      const __m512 high = i + 1 < block.rows ? _mm512_maskz_loadu_ps(mask, even + block.stride + j)
                                             : _mm512_setzero_ps();
      // Zero-masked forms: g++ 12 warns of its own definitions of the others (GCC bug 105593).
      const __m512i even_words =
          _mm512_maskz_cvtepu16_epi32(kAllLanes, (__m256i)_mm512_cvtneps_pbh(low));
      const __m512i odd_words = _mm512_maskz_slli_epi32(
          kAllLanes, _mm512_maskz_cvtepu16_epi32(kAllLanes, (__m256i)_mm512_cvtneps_pbh(high)), 16);
      _mm512_store_si512(out + j * sizeof(Word), _mm512_or_si512(even_words, odd_words));
    }
  }
}

}  // namespace

ProductKernels NativeBfloat16Kernels() {
  return {kLanes, kPanelVectors, 2, &MultiplyPanel, &RoundRows, &PackRows};
}

}  // namespace skein::simd
