// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "base/aligned_vector.h"
#include "simd/product_kernels.h"
#include "simd/target.h"

namespace skein::simd {

/// Of the operands of a product, and of the order of its sums; sums are float32 in each.
enum class Precision {
  kFloat32,
  /// Operands are rounded to bfloat16, to nearest even, denormals to zero. Each pair of elements
  /// along the sum is added as the instruction vdpbf16ps does: fused multiply-adds, the odd element
  /// first, denormal results flushed. Targets with fused multiply-adds agree bit-exactly, with the
  /// instruction (NativeBfloat16) or without.
  kBfloat16,
  /// Operands as for kBfloat16. Sums run over blocks of 32 elements as the instruction tdpbf16ps
  /// (Intel AMX) forms them: even and odd elements apart by fused multiply-adds from zero on, then
  /// the two together onto what there was. Targets agree as they do for kBfloat16, with the
  /// instruction (NativeTiles) or without.
  kTiles,
  /// Sums as for kTiles, of operands that are sums of two bfloat16 each: x rounded, and what it
  /// lacks rounded, together 16 bits of x. The products of two lower parts are left out; of a
  /// block, that of both higher parts comes first, then those with B's and with A's lower part.
  kSplitTiles,
};
constexpr bool IsOfTiles(Precision precision) {
  return precision == Precision::kTiles || precision == Precision::kSplitTiles;
}

/// Scratch memory of one thread's products; grows to what they need.
class ProductWorkspace {
 public:
  /// The next products fetch these floats into the second-level cache while they compute, a line of
  /// the cache for each step along their depth, in the order of the calls. Of more ranges than
  /// kMostFetches the oldest are forgotten.
  void FetchSoon(const float* data, std::int64_t size);
  static constexpr std::uint64_t kMostFetches = 32;
  /// For the kernels: what is to be fetched next, empty if nothing is. Valid until the next call of
  /// either.
  FetchRange* NextFetch();

  /// At least `size` floats from a cache line's boundary on, until the next call.
  float* Left(std::int64_t size) { return Grown(left_, size); }
  float* Right(std::int64_t size) { return Grown(right_, size); }

 private:
  static float* Grown(AlignedVector<float>& memory, std::int64_t size) {
    if (static_cast<std::int64_t>(memory.size()) < size) memory.resize(size);
    return memory.data();
  }

  AlignedVector<float> left_, right_;
  std::array<FetchRange, kMostFetches> fetches_;  ///< of all ranges asked for, the last
  std::uint64_t asked_ = 0, fetched_ = 0;         ///< ranges
};

/// The right factor of a product, [depth][columns], copied into the order in which the kernels of
/// the active target read it. Reading it from many threads is safe.
class PackedMatrix {
 public:
  /// Element (k, j) is data[k * depth_stride + j * column_stride]: a transposed matrix packs by its
  /// strides, one of which is 1. Packing again reuses the memory. Throws Error unless depth and
  /// columns are positive and one stride is 1.
  void Pack(std::int64_t depth, std::int64_t columns, const float* data, std::int64_t depth_stride,
            std::int64_t column_stride, Precision precision);

  std::int64_t depth() const { return depth_; }
  std::int64_t columns() const { return columns_; }
  Precision precision() const { return precision_; }
  /// Products are only possible on the target that was active when this was packed.
  Target target() const { return target_; }

  /// For the kernels: blocks of the depth, in them panels of columns, in them words along the depth
  /// (simd/product_kernels.h).
  const float* words() const { return words_.data(); }

 private:
  std::int64_t depth_ = 0, columns_ = 0;
  Precision precision_ = Precision::kFloat32;
  Target target_ = Target::kScalar;
  AlignedVector<float> words_;
};

/// out = A B, plus what was in `out` in its first `accumulated` columns, and in the others `bias`
/// (by the column of `out`) unless that is null. A has `rows` rows of b.depth() columns, `out`
/// b.columns(); strides are floats between rows. An element of `out` is one sum in one order (what
/// is added, then along the depth): how rows are divided among calls changes no bit. Not-a-number
/// and infinity spread to the elements that depend on them, and to no other. `out` must not
/// overlap A. Throws Error if `b` was packed for another target or not at all.
void Multiply(std::int64_t rows, const float* a, std::int64_t a_stride, const PackedMatrix& b,
              const float* bias, std::int64_t accumulated, float* out, std::int64_t out_stride,
              ProductWorkspace* workspace);

/// out += left^T right, the gradient by a weight: out[i][j] += sum over r of left[r][i] right[r][j]
/// for `rows` rows r. Strides are floats between rows; `out` is [left_columns][right_columns]. An
/// element is one sum in the order of the rows, starting from what was there: dividing rows among
/// successive calls changes no bit, if all calls but the last have an even number of rows for
/// kBfloat16, and a multiple of 32 for the tiles. `out` must not overlap the others.
void AddTransposedProduct(std::int64_t rows, const float* left, std::int64_t left_stride,
                          std::int64_t left_columns, const float* right, std::int64_t right_stride,
                          std::int64_t right_columns, Precision precision, float* out,
                          std::int64_t out_stride, ProductWorkspace* workspace);

}  // namespace skein::simd
