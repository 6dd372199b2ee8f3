// SPDX-License-Identifier: Apache-2.0
// Compiled for AVX512_BF16 and run only where NativeBfloat16(): see simd/bfloat16_vectors.h.

#include <immintrin.h>

#include <cstdint>

#include "simd/bfloat16_vectors.h"
#include "simd/product_kernels.h"

namespace skein::simd {
namespace {

constexpr int kSums = 24, kPanelVectors = 4;

/// out = init + A B for kRows rows and kVectors vectors of columns, of which `last` says which
/// lanes of the last one are not padding; with kFetch, lines from `fetch` on are fetched.
template <int kRows, int kVectors, bool kTransposed, bool kFetch = false>
inline __attribute__((always_inline)) void Tile(const PanelProduct& p, const Word* a,
                                                const float* init, float* out, __mmask16 last,
                                                const char* fetch = nullptr) {
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
    if constexpr (kFetch) {
      _mm_prefetch(fetch, _MM_HINT_T1);
      fetch += kFetchBytes;
    }
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

/// Fetches the sums of a tile, which come from the outer caches, if not from memory.
template <int kRows, int kVectors>
inline __attribute__((always_inline)) void Fetch(const float* sums, std::int64_t stride) {
#pragma GCC unroll 64
  for (int t = 0; t < kRows * kVectors; ++t) {
    _mm_prefetch(sums + t / kVectors * stride + t % kVectors * kLanes, _MM_HINT_T0);
  }
}

/// Tiles of kRows rows, as many as fit between `row` and the end; then one tile of the rest.
template <int kRows, int kVectors, bool kTransposed>
void Strips(const PanelProduct& p, std::int64_t row) {
  if constexpr (kRows > 0) {
    const __mmask16 last = FirstLanes(p.columns - (kVectors - 1) * kLanes);
    for (; row + kRows <= p.rows; row += kRows) {
      Fetch<kRows, kVectors>(p.out + (row + kRows) * p.out_stride, p.out_stride);  // of the next
      const Word* const a = static_cast<const Word*>(p.a) + row * (kTransposed ? 1 : p.a_stride);
      const float* const init = p.init + row * p.init_stride;
      float* const out = p.out + row * p.out_stride;
      constexpr bool kWhole = kRows == kSums / kPanelVectors && kVectors == kPanelVectors;
      if (kWhole && p.fetch->next < p.fetch->end) {
        const char* const fetch = p.fetch->next;
        p.fetch->next += p.depth * kFetchBytes;
        Tile<kRows, kVectors, kTransposed, kWhole>(p, a, init, out, last, fetch);
      } else {
        Tile<kRows, kVectors, kTransposed>(p, a, init, out, last);
      }
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

/// Words of 2 * kLanes floats of one row, of which the first `left` are there.
__m512i RoundedRow(const float* in, std::int64_t left) {
  const __m512 low = _mm512_maskz_loadu_ps(FirstLanes(left), in);
  const __m512 high = left > kLanes ? _mm512_maskz_loadu_ps(FirstLanes(left - kLanes), in + kLanes)
                                    : _mm512_setzero_ps();
  return (__m512i)_mm512_cvtne2ps_pbh(high, low);
}

void RoundRows(const RowBlock& block, std::int64_t words_stride, void* words) {
  constexpr std::int64_t kElements = 2 * kLanes;
  for (std::int64_t i = 0; i < block.rows; ++i) {
    const float* const in = block.data + i * block.stride;
    char* const out = static_cast<char*>(words) + i * words_stride * sizeof(Word);
    std::int64_t j = 0;
    for (; j + kElements <= block.columns; j += kElements) {
      const __m512i row =
          (__m512i)_mm512_cvtne2ps_pbh(_mm512_loadu_ps(in + j + kLanes), _mm512_loadu_ps(in + j));
      _mm512_storeu_si512(out + j / 2 * sizeof(Word), row);
    }
    const std::int64_t left = block.columns - j;
    if (left > 0) {
      _mm512_mask_storeu_epi32(out + j / 2 * sizeof(Word), FirstLanes((left + 1) / 2),
                               RoundedRow(in + j, left));
    }
  }
}

void PackRows(const RowBlock& block, std::int64_t words_stride, void* words) {
  for (std::int64_t i = 0; i < block.rows; i += 2) {
    const float* const even = block.data + i * block.stride;
    // A row behind an odd number of them is zero.
    const bool last = i + 1 == block.rows;
    const float* const odd = last ? even : even + block.stride;
    const __mmask16 odd_lanes = last ? 0 : kAllLanes;
    char* const out = static_cast<char*>(words) + i / 2 * words_stride * sizeof(Word);
    for (std::int64_t j = 0; j < block.columns; j += kLanes) {
      const __mmask16 mask = FirstLanes(block.columns - j);
      _mm512_store_si512(out + j * sizeof(Word),
                         Paired(_mm512_maskz_loadu_ps(mask, even + j),
                                _mm512_maskz_loadu_ps(mask & odd_lanes, odd + j)));
    }
  }
}

}  // namespace

ProductKernels NativeBfloat16Kernels() {
  return {kLanes, kPanelVectors, {2, 1}, &MultiplyPanel, &RoundRows, &PackRows};
}

}  // namespace skein::simd
