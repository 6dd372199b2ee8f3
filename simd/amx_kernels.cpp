// SPDX-License-Identifier: Apache-2.0
// Compiled for AMX_BF16 and AVX512_BF16, and run only where NativeTiles(): see
// simd/bfloat16_vectors.h.

// GCC 12 takes what its own intrinsics leave undefined for a fault (its bug 105593).
#if !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <immintrin.h>
#if !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include <cstdint>

#include "simd/bfloat16_vectors.h"
#include "simd/product_kernels.h"

namespace skein::simd {
namespace {

constexpr int kTileRows = 16;   // of A's and of the sums; columns of B's and of the sums
constexpr int kTileWords = 16;  // along the depth
constexpr int kElements = 2 * kTileWords;
constexpr int kPanelVectors = 2;
// Two tiles of A beside two of B fill the registers with four tiles of sums.
constexpr int kStripRows = 2 * kTileRows, kPanelColumns = kPanelVectors * kLanes;

constexpr int BlockWords(bool split) { return split ? 2 * kTileWords : kTileWords; }

/// The operand of ldtilecfg: shapes of tiles, of which 0 to 3 are sums, 4 and 5 A's, 6 and 7 B's.
struct alignas(64) TileConfig {
  std::uint8_t palette = 1, start_row = 0, reserved[14] = {};
  std::uint16_t row_bytes[16] = {64, 64, 64, 64, 64, 64, 64, 64};
  std::uint8_t rows[16] = {16, 16, 16, 16, 16, 16, 16, 16};
};

/// g++ 12 does not know that loads and stores of tiles touch memory.
inline void MemoryIsTouched() { asm volatile("" ::: "memory"); }

/// A product of fewer rows than a tile has takes tiles of as many, of more whole ones.
void Begin(std::int64_t rows) {
  TileConfig config;
  if (rows < kTileRows) {
    config.rows[0] = config.rows[1] = config.rows[4] = static_cast<std::uint8_t>(rows);
  }
  MemoryIsTouched();
  _tile_loadconfig(&config);
}

void End() { _tile_release(); }

/// Rows of a matrix, `stride` bytes apart.
struct Rows {
  const void* data;
  std::int64_t stride;
};

/// Fetches the next lines of `range`, as many as words of a tile's depth.
inline void FetchLines(FetchRange* range) {
#pragma GCC unroll 16
  for (int i = 0; i < kTileWords; ++i) _mm_prefetch(range->next + i * kFetchBytes, _MM_HINT_T1);
  range->next += kTileWords * kFetchBytes;
}

/// out = init + A B for kDown x kAcross tiles of sums.
template <int kDown, int kAcross, bool kSplit>
inline __attribute__((always_inline)) void Tiles(const PanelProduct& p, const Word* a, Rows init,
                                                 float* out, std::int64_t out_stride) {
  constexpr bool kTwoDown = kDown == 2, kTwoAcross = kAcross == 2;
  const std::int64_t a_stride = p.a_stride * sizeof(Word);
  constexpr std::int64_t kRowWords = kAcross * kLanes, kRowBytes = kRowWords * sizeof(Word);
  const auto load_left = [&](const Word* left) {
    _tile_loadd(4, left, a_stride);
    if constexpr (kTwoDown) _tile_loadd(5, left + kTileRows * p.a_stride, a_stride);
  };
  const auto load_right = [&](const Word* right) {
    _tile_loadd(6, right, kRowBytes);
    if constexpr (kTwoAcross) _tile_loadd(7, right + kLanes, kRowBytes);
  };
  const auto multiply = [&] {
    _tile_dpbf16ps(0, 4, 6);
    if constexpr (kTwoAcross) _tile_dpbf16ps(1, 4, 7);
    if constexpr (kTwoDown) _tile_dpbf16ps(2, 5, 6);
    if constexpr (kTwoDown && kTwoAcross) _tile_dpbf16ps(3, 5, 7);
  };

  MemoryIsTouched();
  const char* const first = static_cast<const char*>(init.data);
  const char* const second = first + kTileRows * init.stride;
  constexpr int kTileBytes = kLanes * sizeof(float);
  _tile_loadd(0, first, init.stride);
  if constexpr (kTwoAcross) _tile_loadd(1, first + kTileBytes, init.stride);
  if constexpr (kTwoDown) _tile_loadd(2, second, init.stride);
  if constexpr (kTwoDown && kTwoAcross) _tile_loadd(3, second + kTileBytes, init.stride);
  const Word* b = static_cast<const Word*>(p.b);
  for (std::int64_t word = 0; word < p.depth; word += BlockWords(kSplit)) {
    if (kTwoDown && kTwoAcross && p.fetch->next < p.fetch->end) FetchLines(p.fetch);
    load_left(a);
    load_right(b);
    multiply();
    if constexpr (kSplit) {
      load_right(b + kTileWords * kRowWords);
      multiply();
      load_left(a + kTileWords);
      load_right(b);
      multiply();
    }
    a += BlockWords(kSplit);
    b += BlockWords(kSplit) * kRowWords;
  }
  const std::int64_t stride = out_stride * sizeof(float);
  _tile_stored(0, out, stride);
  if constexpr (kTwoAcross) _tile_stored(1, out + kLanes, stride);
  if constexpr (kTwoDown) _tile_stored(2, out + kTileRows * out_stride, stride);
  if constexpr (kTwoDown && kTwoAcross) {
    _tile_stored(3, out + kTileRows * out_stride + kLanes, stride);
  }
  MemoryIsTouched();
}

/// Copies `count` rows of `columns` floats, up to kPanelColumns.
inline void CopyRows(std::int64_t count, std::int64_t columns, const float* in,
                     std::int64_t in_stride, float* out, std::int64_t out_stride) {
  const __mmask16 low = FirstLanes(columns);
  const __mmask16 high = columns > kLanes ? FirstLanes(columns - kLanes) : __mmask16{0};
  for (std::int64_t i = 0; i < count; ++i) {
    const float* const from = in + i * in_stride;
    float* const to = out + i * out_stride;
    _mm512_mask_storeu_ps(to, low, _mm512_maskz_loadu_ps(low, from));
    if (high != 0) {
      _mm512_mask_storeu_ps(to + kLanes, high, _mm512_maskz_loadu_ps(high, from + kLanes));
    }
  }
}

/// The rows of A from `row` on, kDown tiles or what is left.
template <int kDown, int kAcross, bool kSplit>
void Strip(const PanelProduct& p, std::int64_t row, std::int64_t rows) {
  const Word* const a = static_cast<const Word*>(p.a) + row * p.a_stride;
  const float* const init = p.init + row * p.init_stride;
  float* const out = p.out + row * p.out_stride;
  const bool whole_rows = rows == kDown * kTileRows || p.rows < kTileRows;
  if (whole_rows && p.columns == kAcross * kLanes) {
    const auto init_bytes = static_cast<std::int64_t>(p.init_stride * sizeof(float));
    Tiles<kDown, kAcross, kSplit>(p, a, {init, init_bytes}, out, p.out_stride);
    return;
  }
  // Rows and columns of padding must not be read or written where others' memory may be.
  alignas(64) float edge[kStripRows * kPanelColumns];
  CopyRows(rows, p.columns, init, p.init_stride, edge, kPanelColumns);
  Tiles<kDown, kAcross, kSplit>(p, a, {edge, kPanelColumns * sizeof(float)}, edge, kPanelColumns);
  CopyRows(rows, p.columns, edge, kPanelColumns, out, p.out_stride);
}

template <int kAcross, bool kSplit>
void MultiplyPanelOf(const PanelProduct& p) {
  for (std::int64_t row = 0; row < p.rows; row += kStripRows) {
    const std::int64_t left = p.rows - row;
    if (left > kTileRows) {
      Strip<2, kAcross, kSplit>(p, row, left < kStripRows ? left : kStripRows);
    } else {
      Strip<1, kAcross, kSplit>(p, row, left);
    }
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

/// What rounding to bfloat16 takes from x.
inline __m512 Lacking(__m512 x) {
  const __m512i words = _mm512_cvtepu16_epi32((__m256i)_mm512_cvtneps_pbh(x));
  return _mm512_sub_ps(x, (__m512)_mm512_slli_epi32(words, 16));
}

/// The block's floats [first, first + kLanes) of a row, zero from `end` on.
inline __m512 LoadFirst(const float* row, std::int64_t first, std::int64_t end) {
  if (first >= end) return _mm512_setzero_ps();
  return _mm512_maskz_loadu_ps(FirstLanes(end - first), row + first);
}

/// Writes the words of a block, of its first and last 16 elements.
template <bool kSplit>
inline void StoreBlock(__m512 first, __m512 last, Word* words) {
  _mm512_storeu_si512(words, (__m512i)_mm512_cvtne2ps_pbh(last, first));
  if constexpr (kSplit) {
    const __m512i lower = (__m512i)_mm512_cvtne2ps_pbh(Lacking(last), Lacking(first));
    _mm512_storeu_si512(words + kTileWords, lower);
  }
}

template <bool kSplit>
void RoundRows(const RowBlock& rows, std::int64_t words_stride, void* words) {
  for (std::int64_t i = 0; i < rows.rows; ++i) {
    const float* const in = rows.data + i * rows.stride;
    Word* out = static_cast<Word*>(words) + i * words_stride;
    std::int64_t j = 0;
    for (; j + kElements <= rows.columns; j += kElements) {
      StoreBlock<kSplit>(_mm512_loadu_ps(in + j), _mm512_loadu_ps(in + j + kLanes), out);
      out += BlockWords(kSplit);
    }
    if (j == rows.columns) continue;
    StoreBlock<kSplit>(LoadFirst(in, j, rows.columns), LoadFirst(in, j + kLanes, rows.columns),
                       out);
  }
}

/// Rows 2 k and 2 k + 1 of a block, which begins at row `block`, from column j on, in pairs; if
/// kLower, of what rounding takes from them. Rows behind the last one are zero; if kWhole, there
/// are none, nor columns.
template <bool kLower, bool kWhole>
inline __m512i RowPair(const RowBlock& rows, std::int64_t block, int k, std::int64_t j) {
  const std::int64_t row = block + 2 * k;
  const float* const in = rows.data + row * rows.stride;
  __m512 even, odd;
  if constexpr (kWhole) {
    even = _mm512_loadu_ps(in + j);
    odd = _mm512_loadu_ps(in + rows.stride + j);
  } else {
    if (row >= rows.rows) return _mm512_setzero_si512();
    even = LoadFirst(in, j, rows.columns);
    odd = row + 1 < rows.rows ? LoadFirst(in + rows.stride, j, rows.columns) : _mm512_setzero_ps();
  }
  return kLower ? Paired(Lacking(even), Lacking(odd)) : Paired(even, odd);
}

bool IsWhole(const RowBlock& rows, std::int64_t block, std::int64_t j) {
  return block + kElements <= rows.rows && j + kLanes <= rows.columns;
}

/// The words of a block, from column j on.
template <bool kSplit, bool kWhole>
inline void PackBlock(const RowBlock& rows, std::int64_t block, std::int64_t j,
                      std::int64_t words_stride, Word* out) {
#pragma GCC unroll 4
  for (int k = 0; k < kTileWords; ++k) {
    Word* const row = out + k * words_stride;
    _mm512_storeu_si512(row, RowPair<false, kWhole>(rows, block, k, j));
    if constexpr (kSplit) {
      _mm512_storeu_si512(row + kTileWords * words_stride,
                          RowPair<true, kWhole>(rows, block, k, j));
    }
  }
}

template <bool kSplit>
void PackRows(const RowBlock& rows, std::int64_t words_stride, void* words) {
  Word* out = static_cast<Word*>(words);
  for (std::int64_t block = 0; block < rows.rows; block += kElements) {
    for (std::int64_t j = 0; j < rows.columns; j += kLanes) {
      if (IsWhole(rows, block, j)) {
        PackBlock<kSplit, true>(rows, block, j, words_stride, out + j);
      } else {
        PackBlock<kSplit, false>(rows, block, j, words_stride, out + j);
      }
    }
    out += BlockWords(kSplit) * words_stride;
  }
}

/// Transposes 16 x 16 words.
inline __attribute__((always_inline)) void Transpose(__m512i (&rows)[16]) {
  __m512i pairs[16];
#pragma GCC unroll 16
  for (int i = 0; i < 16; i += 2) {
    pairs[i] = _mm512_unpacklo_epi32(rows[i], rows[i + 1]);
    pairs[i + 1] = _mm512_unpackhi_epi32(rows[i], rows[i + 1]);
  }
#pragma GCC unroll 16
  for (int i = 0; i < 16; i += 4) {
    rows[i] = _mm512_unpacklo_epi64(pairs[i], pairs[i + 2]);
    rows[i + 1] = _mm512_unpackhi_epi64(pairs[i], pairs[i + 2]);
    rows[i + 2] = _mm512_unpacklo_epi64(pairs[i + 1], pairs[i + 3]);
    rows[i + 3] = _mm512_unpackhi_epi64(pairs[i + 1], pairs[i + 3]);
  }
  // Row 4 b + c holds column c of each of its four quarters, of rows 4 b to 4 b + 3.
#pragma GCC unroll 16
  for (int i = 0; i < 16; i += 8) {
#pragma GCC unroll 4
    for (int c = 0; c < 4; ++c) {
      pairs[i + c] = _mm512_shuffle_i32x4(rows[i + c], rows[i + 4 + c], 0x88);
      pairs[i + 4 + c] = _mm512_shuffle_i32x4(rows[i + c], rows[i + 4 + c], 0xdd);
    }
  }
#pragma GCC unroll 4
  for (int c = 0; c < 4; ++c) {
    rows[c] = _mm512_shuffle_i32x4(pairs[c], pairs[8 + c], 0x88);
    rows[8 + c] = _mm512_shuffle_i32x4(pairs[c], pairs[8 + c], 0xdd);
    rows[4 + c] = _mm512_shuffle_i32x4(pairs[4 + c], pairs[12 + c], 0x88);
    rows[12 + c] = _mm512_shuffle_i32x4(pairs[4 + c], pairs[12 + c], 0xdd);
  }
}

/// The block from `block` on, of columns from j on, transposed.
template <bool kLower, bool kWhole>
inline void TransposeBlock(const RowBlock& rows, std::int64_t block, std::int64_t j,
                           std::int64_t words_stride, Word* out) {
  __m512i words[kTileWords];
#pragma GCC unroll 16
  for (int k = 0; k < kTileWords; ++k) words[k] = RowPair<kLower, kWhole>(rows, block, k, j);
  Transpose(words);
  const std::int64_t left = rows.columns - j;
#pragma GCC unroll 16
  for (int i = 0; i < kLanes; ++i) {
    if (kWhole || i < left) _mm512_storeu_si512(out + i * words_stride, words[i]);
  }
}

template <bool kSplit, bool kWhole>
inline void RoundBlock(const RowBlock& rows, std::int64_t block, std::int64_t j,
                       std::int64_t words_stride, Word* out) {
  TransposeBlock<false, kWhole>(rows, block, j, words_stride, out);
  if constexpr (kSplit) {
    TransposeBlock<true, kWhole>(rows, block, j, words_stride, out + kTileWords);
  }
}

template <bool kSplit>
void RoundColumns(const RowBlock& rows, std::int64_t words_stride, void* words) {
  for (std::int64_t j = 0; j < rows.columns; j += kLanes) {
    Word* out = static_cast<Word*>(words) + j * words_stride;
    for (std::int64_t block = 0; block < rows.rows; block += kElements) {
      if (IsWhole(rows, block, j)) {
        RoundBlock<kSplit, true>(rows, block, j, words_stride, out);
      } else {
        RoundBlock<kSplit, false>(rows, block, j, words_stride, out);
      }
      out += BlockWords(kSplit);
    }
  }
}

template <bool kSplit>
ProductKernels KernelsOf() {
  return {kLanes,
          kPanelVectors,
          {kElements, BlockWords(kSplit)},
          &MultiplyPanel<kSplit>,
          &RoundRows<kSplit>,
          &PackRows<kSplit>,
          &RoundColumns<kSplit>,
          &Begin,
          &End};
}

}  // namespace

ProductKernels NativeTileKernels(bool split) {
  return split ? KernelsOf<true>() : KernelsOf<false>();
}

}  // namespace skein::simd
