// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// What Multiply and AddTransposedProduct (simd/matrix_product.h) are made of, once per target and
// precision. Elements along the depth (the index that is summed over) come in words of 32 bits: a
// float32, or a pair of bfloat16 for processors that multiply those. Some kernels take elements in
// blocks only, a pair or 32, and pad the last one with zeros; a block of elements that are split in
// two has all higher parts before the lower ones. A panel is a strip of B as wide as the
// accumulators of one row: `panel_vectors` vectors, or fewer at the right edge.

namespace skein::simd {

/// Memory that is to be fetched into the second-level cache, from `next` on. Up to a tile's lines
/// too many may be: fetching reads nothing.
struct FetchRange {
  const char* next = nullptr;
  const char* end = nullptr;
};
inline constexpr std::int64_t kFetchBytes = 64;  ///< a line of the cache

/// out = init + A B for all rows and one panel of B. Sums of an element run in the order of the
/// words, whatever the shape is.
struct PanelProduct {
  std::int64_t rows = 0;
  std::int64_t depth = 0;  ///< words
  const void* a = nullptr;
  std::int64_t a_stride = 0;  ///< words between rows of A, or between its columns if transposed
  bool a_transposed = false;  ///< which of both indices is contiguous in memory: the row's
  const void* b = nullptr;    ///< [depth][vectors * lanes] words
  std::int64_t b_stride = 0;  ///< words between rows of B: vectors * lanes unless A is transposed
  int vectors = 0;            ///< 1 to panel_vectors
  int columns = 0;            ///< of init and out, up to vectors * lanes; the others are padding
  const float* init = nullptr;
  std::int64_t init_stride = 0;
  float* out = nullptr;  ///< may be `init`
  std::int64_t out_stride = 0;
  FetchRange* fetch = nullptr;  ///< whole tiles fetch a line for each word of their depth
};

/// Rows of float32 that are to become words.
struct RowBlock {
  std::int64_t rows = 0, columns = 0;
  const float* data = nullptr;
  std::int64_t stride = 0;
};

/// A block of the depth, of which every matrix has whole ones.
struct DepthBlock {
  int elements = 1;
  int words = 1;  ///< that they are
};

struct ProductKernels {
  int lanes = 0;          ///< words of a vector
  int panel_vectors = 0;  ///< vectors of a whole panel
  DepthBlock block;

  void (*multiply_panel)(const PanelProduct& product) = nullptr;

  /// Words along the columns of `rows`, [rows][words of the columns]: A of a product, rounded. Null
  /// if A needs no rounding.
  void (*round_rows)(const RowBlock& rows, std::int64_t words_stride, void* words) = nullptr;

  /// Words along the rows of `rows`: [words of the rows][stride], zero from `columns` to the next
  /// multiple of `lanes`: B of a product, or A transposed.
  void (*pack_rows)(const RowBlock& rows, std::int64_t words_stride, void* words) = nullptr;

  /// Words along the rows of `rows`, [columns][words of the rows]: A transposed for kernels that
  /// cannot read it as pack_rows leaves it; null for others.
  void (*round_columns)(const RowBlock& rows, std::int64_t words_stride, void* words) = nullptr;

  /// What a thread does before it multiplies panels of as many rows, and behind the last one; null
  /// if nothing.
  void (*begin)(std::int64_t rows) = nullptr;
  void (*end)() = nullptr;
};

/// out[j * out_stride + i] = the element of `rows` in row i and column j. No alignment is needed;
/// out_stride is rows.rows at least, and `out` overlaps nothing.
void TransposeRows(const RowBlock& rows, std::int64_t out_stride, float* out);

/// Kernels of the active target with float32 operands.
ProductKernels Float32Kernels();

/// Kernels of the active target with operands rounded to bfloat16 and kept as float32: products of
/// two bfloat16 are exact in float32, so that fused multiply-adds in the order of the instruction
/// vdpbf16ps (the odd element of a pair first) give what it gives.
ProductKernels EmulatedBfloat16Kernels();

/// Kernels with the instruction vdpbf16ps; only where NativeBfloat16() (simd/target.h).
ProductKernels NativeBfloat16Kernels();

/// As EmulatedBfloat16Kernels, with sums in the order of the instruction tdpbf16ps; if `split`,
/// operands are kSplitTiles'.
ProductKernels EmulatedTileKernels(bool split);

/// Kernels with the instruction tdpbf16ps; only where NativeTiles() (simd/target.h).
ProductKernels NativeTileKernels(bool split);

}  // namespace skein::simd
