// SPDX-License-Identifier: Apache-2.0
#include "simd/matrix_product.h"

#include <algorithm>
#include <optional>
#include <string>

#include "base/denormals.h"
#include "base/error.h"
#include "simd/product_kernels.h"

namespace skein::simd {
namespace {

// Sums run in memory between blocks of the depth; a block of a panel stays in the second-level
// cache.
constexpr std::int64_t kDepthBlock = 384;  // words
constexpr std::int64_t kRowBlock = 96;
// As many rows of both factors of a transposed product, a panel and a strip, stay in the
// first-level cache, and their pages in its translation buffer. Even, so that pairs are whole.
constexpr std::int64_t kTransposedBlock = kRowBlock / 2;  // words
// Rows of a matrix that are packed together. Even, so that pairs are whole; a divisor of
// kDepthBlock.
constexpr std::int64_t kStripRows = 32;
constexpr std::int64_t kLineWords = 16;  // of a cache line
// Rows of a power of two of words would all begin in the same few sets of the cache.
constexpr std::int64_t kRoundedStride = kDepthBlock + kLineWords;

/// DenormalsFlushed, or nothing.
class FlushIf {
 public:
  explicit FlushIf(bool flush) {
    if (flush) flushed_.emplace();
  }

 private:
  std::optional<DenormalsFlushed> flushed_;
};

ProductKernels KernelsFor(Precision precision) {
  if (precision == Precision::kFloat32) return Float32Kernels();
  if (precision == Precision::kBfloat16) {
#ifdef SKEIN_NATIVE_BFLOAT16
    if (NativeBfloat16()) return NativeBfloat16Kernels();
#endif
    return EmulatedBfloat16Kernels();
  }
  const bool split = precision == Precision::kSplitTiles;
#ifdef SKEIN_NATIVE_TILES
  if (NativeTiles()) return NativeTileKernels(split);
#endif
  return EmulatedTileKernels(split);
}

/// What a thread does before it multiplies panels and behind them.
class Multiplying {
 public:
  explicit Multiplying(const ProductKernels& kernels) : kernels_(kernels) {}
  ~Multiplying() {
    if (rows_ > 0) kernels_.end();
  }
  Multiplying(const Multiplying&) = delete;
  Multiplying& operator=(const Multiplying&) = delete;

  void Begin(std::int64_t rows) {
    if (kernels_.begin == nullptr || rows == rows_) return;
    kernels_.begin(rows);
    rows_ = rows;
  }

 private:
  const ProductKernels& kernels_;
  std::int64_t rows_ = 0;  // that it has begun with
};

std::int64_t RoundUp(std::int64_t n, std::int64_t multiple) {
  return (n + multiple - 1) / multiple * multiple;
}

/// Words of `depth` elements; blocks are whole ones.
std::int64_t Words(std::int64_t depth, const DepthBlock& block) {
  return RoundUp(depth, block.elements) / block.elements * block.words;
}

/// Elements of whole blocks that make `words` words, or one block.
std::int64_t Elements(std::int64_t words, const DepthBlock& block) {
  return std::max<std::int64_t>(words / block.words, 1) * block.elements;
}

/// The panels of a block of B, one behind the other: [panel][depth][columns].
class PanelRow {
 public:
  PanelRow(const ProductKernels& kernels, std::int64_t columns)
      : width_(kernels.lanes * kernels.panel_vectors), lanes_(kernels.lanes), columns_(columns) {}

  std::int64_t count() const { return (columns_ + width_ - 1) / width_; }
  std::int64_t first_column(std::int64_t panel) const { return panel * width_; }
  int columns(std::int64_t panel) const {
    return static_cast<int>(std::min(width_, columns_ - first_column(panel)));
  }
  int vectors(std::int64_t panel) const {
    return static_cast<int>((columns(panel) + lanes_ - 1) / lanes_);
  }
  /// Words between rows of a panel.
  std::int64_t stride(std::int64_t panel) const { return vectors(panel) * lanes_; }
  /// Words of all panels, for each word of depth.
  std::int64_t padded_columns() const { return RoundUp(columns_, lanes_); }

 private:
  std::int64_t width_, lanes_, columns_;
};

/// A block of B. Its panels are packed one behind the other, unless its rows are as they were
/// given.
struct RightBlock {
  const float* data = nullptr;
  std::int64_t row_stride = 0;  // 0 if packed
};

/// What sums start from: in the first `accumulated` columns what is in `out`, in the others the
/// bias, or zero if that is null.
struct Start {
  const float* bias = nullptr;
  std::int64_t accumulated = 0;
};

/// Writes what the columns [first, end) start from, which is not there yet, to all rows of `out`.
void WriteStart(const Start& start, std::int64_t first, std::int64_t end, std::int64_t rows,
                float* out, std::int64_t stride) {
  if (first >= end) return;
  for (std::int64_t i = 0; i < rows; ++i) {
    for (std::int64_t j = first; j < end; ++j) {
      out[i * stride + j] = start.bias == nullptr ? 0.0f : start.bias[j];
    }
  }
}

/// Multiplies a block of A by all panels of a block of B.
void MultiplyPanels(const ProductKernels& kernels, const PanelRow& panels, const RightBlock& b,
                    const Start& start, PanelProduct product, ProductWorkspace* workspace) {
  static constexpr float kZeros[64] = {};
  float* const out = product.out;
  for (std::int64_t panel = 0; panel < panels.count(); ++panel) {
    const std::int64_t column = panels.first_column(panel);
    const bool packed = b.row_stride == 0;
    product.b = b.data + (packed ? column * product.depth : column);
    product.b_stride = packed ? panels.stride(panel) : b.row_stride;
    product.vectors = panels.vectors(panel);
    product.columns = panels.columns(panel);
    product.out = out + column;
    if (column < start.accumulated) {
      WriteStart(start, start.accumulated, column + product.columns, product.rows, out,
                 product.out_stride);
      product.init = product.out;
      product.init_stride = product.out_stride;
    } else {
      product.init = start.bias == nullptr ? kZeros : start.bias + column;
      product.init_stride = 0;
    }
    product.fetch = workspace->NextFetch();
    kernels.multiply_panel(product);
  }
}

}  // namespace

void ProductWorkspace::FetchSoon(const float* data, std::int64_t size) {
  fetches_[asked_++ % kMostFetches] = {reinterpret_cast<const char*>(data),
                                       reinterpret_cast<const char*>(data + size)};
  fetched_ = std::max(fetched_, asked_ - std::min(asked_, kMostFetches));
}

FetchRange* ProductWorkspace::NextFetch() {
  const auto is_empty = [](const FetchRange& range) { return range.next >= range.end; };
  while (fetched_ < asked_ && is_empty(fetches_[fetched_ % kMostFetches])) ++fetched_;
  // Behind the last one lies one that is empty, or the oldest, which is.
  return &fetches_[fetched_ % kMostFetches];
}

void PackedMatrix::Pack(std::int64_t depth, std::int64_t columns, const float* data,
                        std::int64_t depth_stride, std::int64_t column_stride,
                        Precision precision) {
  if (depth < 1 || columns < 1) {
    throw Error("PackedMatrix: " + std::to_string(depth) + " x " + std::to_string(columns) +
                " elements; both must be positive");
  }
  if (depth_stride != 1 && column_stride != 1) {
    throw Error("PackedMatrix: strides of " + std::to_string(depth_stride) + " and " +
                std::to_string(column_stride) + "; one must be 1");
  }
  const ProductKernels kernels = KernelsFor(precision);
  const PanelRow panels(kernels, columns);
  depth_ = depth;
  columns_ = columns;
  precision_ = precision;
  target_ = ActiveTarget();
  words_.resize(Words(depth, kernels.block) * panels.padded_columns());

  AlignedVector<float> strip;  // of a panel, where its rows are not contiguous
  float* out = words_.data();
  const std::int64_t block_rows = Elements(kDepthBlock, kernels.block);
  for (std::int64_t block = 0; block < depth; block += block_rows) {
    const std::int64_t end = std::min(depth, block + block_rows);
    for (std::int64_t panel = 0; panel < panels.count(); ++panel) {
      const float* const from = data + panels.first_column(panel) * column_stride;
      const std::int64_t stride = panels.stride(panel);
      for (std::int64_t k = block; k < end; k += kStripRows) {
        RowBlock rows{std::min(kStripRows, end - k), panels.columns(panel), from + k * depth_stride,
                      depth_stride};
        if (column_stride != 1) {
          strip.resize(kStripRows * stride);
          TransposeRows({rows.columns, rows.rows, rows.data, column_stride}, stride, strip.data());
          rows.data = strip.data();
          rows.stride = stride;
        }
        kernels.pack_rows(rows, stride, out);
        out += Words(rows.rows, kernels.block) * stride;
      }
    }
  }
}

void Multiply(std::int64_t rows, const float* a, std::int64_t a_stride, const PackedMatrix& b,
              const float* bias, std::int64_t accumulated, float* out, std::int64_t out_stride,
              ProductWorkspace* workspace) {
  if (b.depth() == 0 || b.target() != ActiveTarget()) {
    throw Error(std::string("Multiply: the matrix is not packed for ") + Name(ActiveTarget()));
  }
  const ProductKernels kernels = KernelsFor(b.precision());
  const PanelRow panels(kernels, b.columns());
  const std::int64_t words = Words(b.depth(), kernels.block);
  const FlushIf flush(b.precision() != Precision::kFloat32);
  Multiplying multiplying(kernels);
  for (std::int64_t row = 0; row < rows; row += kRowBlock) {
    PanelProduct product;
    product.rows = std::min(kRowBlock, rows - row);
    multiplying.Begin(product.rows);
    product.out = out + row * out_stride;
    product.out_stride = out_stride;
    Start start{bias, accumulated};
    for (std::int64_t word = 0; word < words; word += kDepthBlock) {
      product.depth = std::min(kDepthBlock, words - word);
      const std::int64_t first = word / kernels.block.words * kernels.block.elements;
      const float* const block = a + row * a_stride + first;
      if (kernels.round_rows == nullptr) {
        product.a = block;
        product.a_stride = a_stride;
      } else {
        product.a_stride = kRoundedStride;
        float* const rounded = workspace->Left(kRowBlock * kRoundedStride);
        const std::int64_t elements =
            std::min(Elements(product.depth, kernels.block), b.depth() - first);
        kernels.round_rows({product.rows, elements, block, a_stride}, kRoundedStride, rounded);
        product.a = rounded;
      }
      MultiplyPanels(kernels, panels, {b.words() + word * panels.padded_columns()}, start, product,
                     workspace);
      start.accumulated = b.columns();
    }
  }
}

void AddTransposedProduct(std::int64_t rows, const float* left, std::int64_t left_stride,
                          std::int64_t left_columns, const float* right, std::int64_t right_stride,
                          std::int64_t right_columns, Precision precision, float* out,
                          std::int64_t out_stride, ProductWorkspace* workspace) {
  const ProductKernels kernels = KernelsFor(precision);
  const PanelRow panels(kernels, right_columns);
  const bool rounds = precision != Precision::kFloat32;
  const FlushIf flush(rounds);
  Multiplying multiplying(kernels);
  if (rows > 0) multiplying.Begin(left_columns);
  // Whole vectors can be read where they are.
  const bool packs = rounds || right_columns % kernels.lanes != 0;
  const std::int64_t block_rows = Elements(kTransposedBlock, kernels.block);
  const std::int64_t block_words = Words(block_rows, kernels.block);
  PanelProduct product;
  product.rows = left_columns;
  product.a_transposed = kernels.round_columns == nullptr;
  product.out = out;
  product.out_stride = out_stride;
  for (std::int64_t row = 0; row < rows; row += block_rows) {
    const std::int64_t count = std::min(block_rows, rows - row);
    product.depth = Words(count, kernels.block);
    const RowBlock block{count, left_columns, left + row * left_stride, left_stride};
    product.a = block.data;
    product.a_stride = left_stride;
    if (kernels.round_columns != nullptr) {
      product.a_stride = block_words + kLineWords;
      float* const a = workspace->Left(RoundUp(left_columns, kernels.lanes) * product.a_stride);
      kernels.round_columns(block, product.a_stride, a);
      product.a = a;
    } else if (rounds) {
      product.a_stride = RoundUp(left_columns, kernels.lanes) + kLineWords;
      float* const a = workspace->Left(block_words * product.a_stride);
      kernels.pack_rows(block, product.a_stride, a);
      product.a = a;
    }
    RightBlock b{right + row * right_stride, right_stride};
    if (packs) {
      float* const words = workspace->Right(block_words * panels.padded_columns());
      for (std::int64_t panel = 0; panel < panels.count(); ++panel) {
        const std::int64_t column = panels.first_column(panel);
        kernels.pack_rows({count, panels.columns(panel), b.data + column, right_stride},
                          panels.stride(panel), words + column * product.depth);
      }
      b = {words};
    }
    MultiplyPanels(kernels, panels, b, {nullptr, right_columns}, product, workspace);
  }
}

}  // namespace skein::simd
