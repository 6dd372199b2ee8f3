// SPDX-License-Identifier: Apache-2.0
#include "simd/product_kernels.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "simd/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/product_kernels.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/bfloat16-inl.h"
#include "simd/transpose-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

using simd::PanelProduct;
using simd::RowBlock;

// Sums of a tile, and vectors of a whole panel: with the vectors of B and a broadcast of A they
// fill the registers, 32 on avx512 and AArch64 and 16 on the others.
#if HWY_TARGET == HWY_AVX3 || (HWY_ARCH_ARM_A64 && HWY_TARGET != HWY_SCALAR)
constexpr int kSums = 24, kPanelVectors = 4;
#elif HWY_TARGET == HWY_AVX2
constexpr int kSums = 12, kPanelVectors = 2;
#else
constexpr int kSums = 8, kPanelVectors = 2;
#endif

/// Fetches a line of the cache into the second level.
HWY_INLINE void FetchOuter(const char* line) { __builtin_prefetch(line, 0, 2); }

/// out = init + A B for kRows rows and kVectors vectors of columns; with kFetch, lines from `fetch`
/// on are fetched.
template <int kRows, int kVectors, bool kTransposed, bool kFetch = false>
HWY_INLINE void Tile(std::int64_t depth, const float* HWY_RESTRICT a, std::int64_t a_stride,
                     const float* HWY_RESTRICT b, std::int64_t b_stride, const float* init,
                     std::int64_t init_stride, float* out, std::int64_t out_stride,
                     const char* fetch = nullptr) {
  const FloatTag d;
  // One loop, not two: g++ unrolls nested ones too late to keep the sums in registers.
  V sum[kRows * kVectors];
  HWY_UNROLL(64)
  for (int t = 0; t < kRows * kVectors; ++t) {
    sum[t] = hn::LoadU(d, init + t / kVectors * init_stride + t % kVectors * kLanes);
  }
  HWY_UNROLL(2)
  for (std::int64_t k = 0; k < depth; ++k) {
    V right[kVectors];
    HWY_UNROLL(16)
    for (int j = 0; j < kVectors; ++j) right[j] = hn::LoadU(d, b + j * kLanes);
    if constexpr (kFetch) {
      FetchOuter(fetch);
      fetch += simd::kFetchBytes;
    }
    HWY_UNROLL(16)
    for (int i = 0; i < kRows; ++i) {
      const V left = hn::Set(d, kTransposed ? a[i] : a[i * a_stride]);
      HWY_UNROLL(16)
      for (int j = 0; j < kVectors; ++j) {
        sum[i * kVectors + j] = hn::MulAdd(left, right[j], sum[i * kVectors + j]);
      }
    }
    a += kTransposed ? a_stride : 1;
    b += kTransposed ? b_stride : kVectors * kLanes;
  }
  HWY_UNROLL(64)
  for (int t = 0; t < kRows * kVectors; ++t) {
    hn::StoreU(sum[t], d, out + t / kVectors * out_stride + t % kVectors * kLanes);
  }
}

/// Fetches the sums of a tile, which come from the outer caches, if not from memory.
template <int kRows, int kVectors>
HWY_INLINE void Fetch(const float* sums, std::int64_t stride) {
  constexpr int kLineFloats = 16;  // of a cache line
  HWY_UNROLL(16)
  for (int i = 0; i < kRows; ++i) {
    for (int j = 0; j < kVectors * kLanes; j += kLineFloats) hwy::Prefetch(sums + i * stride + j);
  }
}

/// Tiles of kRows rows, as many as fit between `row` and the end; then one tile of the rest.
template <int kRows, int kVectors, bool kTransposed>
void Strips(const PanelProduct& p, std::int64_t row) {
  if constexpr (kRows > 0) {
    const float* const a = static_cast<const float*>(p.a);
    const float* const b = static_cast<const float*>(p.b);
    for (; row + kRows <= p.rows; row += kRows) {
      const float* const strip = a + row * (kTransposed ? 1 : p.a_stride);
      const float* const init = p.init + row * p.init_stride;
      float* const out = p.out + row * p.out_stride;
      Fetch<kRows, kVectors>(out + kRows * p.out_stride, p.out_stride);  // of the next tile
      constexpr bool kWhole = kRows == kSums / kPanelVectors && kVectors == kPanelVectors;
      if (kWhole && p.columns == kVectors * kLanes && p.fetch->next < p.fetch->end) {
        const char* const fetch = p.fetch->next;
        p.fetch->next += p.depth * simd::kFetchBytes;
        Tile<kRows, kVectors, kTransposed, kWhole>(p.depth, strip, p.a_stride, b, p.b_stride, init,
                                                   p.init_stride, out, p.out_stride, fetch);
      } else if (p.columns == kVectors * kLanes) {
        Tile<kRows, kVectors, kTransposed>(p.depth, strip, p.a_stride, b, p.b_stride, init,
                                           p.init_stride, out, p.out_stride);
      } else {
        // Columns of padding must not be read or written where others' memory may be.
        const std::size_t bytes = p.columns * sizeof(float);
        HWY_ALIGN float edge[kRows][kVectors * kLanes] = {};
        for (int i = 0; i < kRows; ++i) std::memcpy(edge[i], init + i * p.init_stride, bytes);
        Tile<kRows, kVectors, kTransposed>(p.depth, strip, p.a_stride, b, p.b_stride, edge[0],
                                           kVectors * kLanes, edge[0], kVectors * kLanes);
        for (int i = 0; i < kRows; ++i) std::memcpy(out + i * p.out_stride, edge[i], bytes);
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
    constexpr int kRows = std::min(kMostRows, kSums / kVectors);
    if (p.a_transposed) {
      Strips<kRows, kVectors, true>(p, 0);
    } else {
      Strips<kRows, kVectors, false>(p, 0);
    }
  }
}

void MultiplyPanel(const PanelProduct& p) { MultiplyPanelOf<kPanelVectors>(p); }

/// Copies `columns` floats, as they are or rounded, and zeros up to the next multiple of kLanes.
template <bool kRound>
HWY_INLINE void PackRow(std::int64_t columns, const float* in, float* out) {
  const FloatTag d;
  std::int64_t j = 0;
  for (; j + kLanes <= columns; j += kLanes) {
    const V x = hn::LoadU(d, in + j);
    hn::Store(kRound ? Rounded(x) : x, d, out + j);
  }
  if (j == columns) return;
  HWY_ALIGN float edge[kLanes] = {};
  std::memcpy(edge, in + j, (columns - j) * sizeof(float));
  const V x = hn::Load(d, edge);
  hn::Store(kRound ? Rounded(x) : x, d, out + j);
}

void PackRowsAsTheyAre(const RowBlock& block, std::int64_t words_stride, void* words) {
  float* const out = static_cast<float*>(words);
  for (std::int64_t i = 0; i < block.rows; ++i) {
    PackRow<false>(block.columns, block.data + i * block.stride, out + i * words_stride);
  }
}

void PackRowsRounded(const RowBlock& block, std::int64_t words_stride, void* words) {
  float* const out = static_cast<float*>(words);
  for (std::int64_t i = 0; i < block.rows; ++i) {
    // The odd row of a pair goes first.
    PackRow<true>(block.columns, block.data + i * block.stride, out + (i ^ 1) * words_stride);
  }
  if (block.rows % 2 == 0) return;
  const std::int64_t padded = (block.columns + kLanes - 1) / kLanes * kLanes;
  std::fill_n(out + (block.rows - 1) * words_stride, padded, 0.0f);
}

void RoundRows(const RowBlock& block, std::int64_t words_stride, void* words) {
  const FloatTag d;
  for (std::int64_t i = 0; i < block.rows; ++i) {
    const float* const in = block.data + i * block.stride;
    float* const out = static_cast<float*>(words) + i * words_stride;
    std::int64_t j = 0;
    for (; j + kLanes <= block.columns; j += kLanes) {
      const V rounded = Rounded(hn::LoadU(d, in + j));
#if HWY_TARGET == HWY_SCALAR
      out[j ^ 1] = hn::GetLane(rounded);
#else
      hn::StoreU(hn::Shuffle2301(rounded), d, out + j);
#endif
    }
    for (; j < block.columns; ++j) {
      out[j ^ 1] = hn::GetLane(Rounded(hn::Set(d, in[j])));
    }
    if (block.columns % 2 != 0) out[block.columns - 1] = 0;
  }
}

void TransposeRowsKernel(const RowBlock& rows, std::int64_t out_stride, float* out) {
  const FloatTag d;
  std::int64_t i = 0;
  for (; i + kLanes <= rows.rows; i += kLanes) {
    const float* const in = rows.data + i * rows.stride;
    std::int64_t j = 0;
    for (; j + kLanes <= rows.columns; j += kLanes) {
      V square[kLanes];
      for (int k = 0; k < kLanes; ++k) square[k] = hn::LoadU(d, in + k * rows.stride + j);
      Transpose(d, square);
      for (int k = 0; k < kLanes; ++k) hn::StoreU(square[k], d, out + (j + k) * out_stride + i);
    }
    for (; j < rows.columns; ++j) {
      for (int k = 0; k < kLanes; ++k) out[j * out_stride + i + k] = in[k * rows.stride + j];
    }
  }
  for (; i < rows.rows; ++i) {
    const float* const in = rows.data + i * rows.stride;
    for (std::int64_t j = 0; j < rows.columns; ++j) out[j * out_stride + i] = in[j];
  }
}

simd::ProductKernels Kernels(bool rounded) {
  if (rounded) {
    return {kLanes, kPanelVectors, {2, 2}, &MultiplyPanel, &RoundRows, &PackRowsRounded};
  }
  return {kLanes, kPanelVectors, {1, 1}, &MultiplyPanel, nullptr, &PackRowsAsTheyAre};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {
HWY_EXPORT(Kernels);
HWY_EXPORT(TransposeRowsKernel);

namespace simd {

void TransposeRows(const RowBlock& rows, std::int64_t out_stride, float* out) {
  SKEIN_DISPATCH(TransposeRowsKernel)(rows, out_stride, out);
}

ProductKernels Float32Kernels() { return SKEIN_DISPATCH(Kernels)(false); }

ProductKernels EmulatedBfloat16Kernels() { return SKEIN_DISPATCH(Kernels)(true); }

}  // namespace simd
}  // namespace skein
#endif
