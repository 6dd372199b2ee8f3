// SPDX-License-Identifier: Apache-2.0
// What tdpbf16ps computes (simd/matrix_product.h), by multiply-adds of rounded float32.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "simd/dispatch.h"
#include "simd/product_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/tile_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/bfloat16-inl.h"
#include "simd/vocabulary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {
namespace {

using simd::PanelProduct;
using simd::RowBlock;

constexpr int kElements = 32;  // of a block
constexpr int kPanelVectors = 2;

/// Words of a block: every element's, or every higher part's, then every lower part's.
constexpr int Words(bool split) { return split ? 2 * kElements : kElements; }

/// The sums of one row and of kVectors vectors of columns, over one block.
template <int kVectors>
struct RowSums {
  V even[kVectors], odd[kVectors];
};

/// out += A B of one block, for one row.
template <int kVectors>
HWY_INLINE void AddBlock(const float* HWY_RESTRICT a, const float* HWY_RESTRICT b, float* out) {
  const FloatTag d;
  constexpr std::int64_t kRow = kVectors * kLanes;
  RowSums<kVectors> sums;
  for (int j = 0; j < kVectors; ++j) sums.even[j] = sums.odd[j] = hn::Zero(d);
  for (int k = 0; k < kElements; k += 2) {
    const V even = hn::Set(d, a[k]), odd = hn::Set(d, a[k + 1]);
    for (int j = 0; j < kVectors; ++j) {
      const float* const column = b + k * kRow + j * kLanes;
      sums.even[j] = hn::MulAdd(even, hn::Load(d, column), sums.even[j]);
      sums.odd[j] = hn::MulAdd(odd, hn::Load(d, column + kRow), sums.odd[j]);
    }
  }
  for (int j = 0; j < kVectors; ++j) {
    float* const sum = out + j * kLanes;
    hn::Store(hn::Add(hn::Load(d, sum), hn::Add(sums.even[j], sums.odd[j])), d, sum);
  }
}

template <int kVectors, bool kSplit>
void MultiplyPanelOf(const PanelProduct& p) {
  constexpr std::int64_t kWords = Words(kSplit), kRow = kVectors * kLanes;
  const std::size_t bytes = p.columns * sizeof(float);
  for (std::int64_t i = 0; i < p.rows; ++i) {
    HWY_ALIGN float sums[kRow] = {};
    std::memcpy(sums, p.init + i * p.init_stride, bytes);
    for (std::int64_t word = 0; word < p.depth; word += kWords) {
      if (p.fetch->next < p.fetch->end) p.fetch->next += simd::kFetchBytes;  // not worth fetching
      const float* const a = static_cast<const float*>(p.a) + i * p.a_stride + word;
      const float* const b = static_cast<const float*>(p.b) + word * kRow;
      AddBlock<kVectors>(a, b, sums);
      if constexpr (kSplit) {
        AddBlock<kVectors>(a, b + kElements * kRow, sums);
        AddBlock<kVectors>(a + kElements, b, sums);
      }
    }
    std::memcpy(p.out + i * p.out_stride, sums, bytes);
  }
}

template <bool kSplit>
void MultiplyPanel(const PanelProduct& p) {
  if (p.vectors == kPanelVectors) {
    MultiplyPanelOf<kPanelVectors, kSplit>(p);
  } else {
    MultiplyPanelOf<1, kSplit>(p);
  }
}

/// Writes the words of a block's element: to `words`, and what it lacks to `lower`.
template <bool kSplit>
HWY_INLINE void StoreRounded(V x, float* words, float* lower) {
  const FloatTag d;
  const V high = Rounded(x);
  hn::StoreU(high, d, words);
  if constexpr (kSplit) hn::StoreU(Rounded(hn::Sub(x, high)), d, lower);
}

/// `columns` floats and zeros behind them, up to kLanes.
HWY_INLINE V LoadFirst(std::int64_t columns, const float* in) {
  const FloatTag d;
  if (columns >= kLanes) return hn::LoadU(d, in);
  HWY_ALIGN float edge[kLanes] = {};
  std::memcpy(edge, in, columns * sizeof(float));
  return hn::Load(d, edge);
}

template <bool kSplit>
void RoundRows(const RowBlock& rows, std::int64_t words_stride, void* words) {
  for (std::int64_t i = 0; i < rows.rows; ++i) {
    const float* const in = rows.data + i * rows.stride;
    float* out = static_cast<float*>(words) + i * words_stride;
    for (std::int64_t block = 0; block < rows.columns; block += kElements) {
      for (int k = 0; k < kElements; k += kLanes) {
        const std::int64_t left = std::max<std::int64_t>(rows.columns - block - k, 0);
        StoreRounded<kSplit>(LoadFirst(left, in + block + k), out + k, out + kElements + k);
      }
      out += Words(kSplit);
    }
  }
}

template <bool kSplit>
void PackRows(const RowBlock& rows, std::int64_t words_stride, void* words) {
  float* out = static_cast<float*>(words);
  for (std::int64_t block = 0; block < rows.rows; block += kElements) {
    for (int k = 0; k < kElements; ++k) {
      float* const row = out + k * words_stride;
      for (std::int64_t j = 0; j < rows.columns; j += kLanes) {
        // Rows behind the last one are zero.
        const std::int64_t left = block + k < rows.rows ? rows.columns - j : 0;
        const float* const in = rows.data + (block + k) * rows.stride + j;
        StoreRounded<kSplit>(LoadFirst(left, in), row + j, row + kElements * words_stride + j);
      }
    }
    out += Words(kSplit) * words_stride;
  }
}

template <bool kSplit>
void RoundColumns(const RowBlock& rows, std::int64_t words_stride, void* words) {
  for (std::int64_t j = 0; j < rows.columns; ++j) {
    float* out = static_cast<float*>(words) + j * words_stride;
    for (std::int64_t block = 0; block < rows.rows; block += kElements) {
      HWY_ALIGN float column[kElements] = {};
      const std::int64_t count = std::min<std::int64_t>(kElements, rows.rows - block);
      for (std::int64_t i = 0; i < count; ++i) {
        column[i] = rows.data[(block + i) * rows.stride + j];
      }
      RoundRows<kSplit>({1, kElements, column, kElements}, words_stride, out);
      out += Words(kSplit);
    }
  }
}

template <bool kSplit>
simd::ProductKernels KernelsOf() {
  return {kLanes,
          kPanelVectors,
          {kElements, Words(kSplit)},
          &MultiplyPanel<kSplit>,
          &RoundRows<kSplit>,
          &PackRows<kSplit>,
          &RoundColumns<kSplit>};
}

simd::ProductKernels TileKernels(bool split) {
  return split ? KernelsOf<true>() : KernelsOf<false>();
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skein {
HWY_EXPORT(TileKernels);

namespace simd {

ProductKernels EmulatedTileKernels(bool split) { return SKEIN_DISPATCH(TileKernels)(split); }

}  // namespace simd
}  // namespace skein
#endif
