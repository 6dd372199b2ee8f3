// SPDX-License-Identifier: Apache-2.0
#include "simd/matrix_product.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "base/error.h"
#include "base/fnv_hash.h"
#include "gtest/gtest.h"
#include "simd/target.h"
#include "tests/scoped_target.h"
#include "tests/simd/bfloat16.h"
#include "tests/tolerance.h"

namespace skein::simd {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
// What lies between rows, where nothing may be read into a result or written.
constexpr float kBetweenRows = 12345.0f;

/// A row-major matrix whose rows are further apart than they are long.
struct Matrix {
  Matrix(std::int64_t rows_, std::int64_t columns_, std::int64_t gap = 3)
      : rows(rows_),
        columns(columns_),
        stride(columns_ + gap),
        data(static_cast<std::size_t>(rows_ * stride), kBetweenRows) {}

  float& At(std::int64_t i, std::int64_t j) { return data[i * stride + j]; }
  float At(std::int64_t i, std::int64_t j) const { return data[i * stride + j]; }

  std::int64_t rows, columns, stride;
  std::vector<float> data;
};

Matrix Random(std::int64_t rows, std::int64_t columns, unsigned seed, std::int64_t gap = 3) {
  std::mt19937 generator(seed);
  std::normal_distribution<float> normal(0, 1);
  Matrix matrix(rows, columns, gap);
  for (std::int64_t i = 0; i < rows; ++i) {
    for (std::int64_t j = 0; j < columns; ++j) matrix.At(i, j) = normal(generator);
  }
  return matrix;
}

PackedMatrix Packed(const Matrix& b, Precision precision) {
  PackedMatrix packed;
  packed.Pack(b.rows, b.columns, b.data.data(), b.stride, 1, precision);
  return packed;
}

void Multiply(const Matrix& a, const PackedMatrix& b, const float* bias, std::int64_t accumulated,
              Matrix* out) {
  ProductWorkspace workspace;
  simd::Multiply(a.rows, a.data.data(), a.stride, b, bias, accumulated, out->data.data(),
                 out->stride, &workspace);
}

void AddTransposedProduct(const Matrix& left, const Matrix& right, Precision precision,
                          Matrix* out) {
  ProductWorkspace workspace;
  simd::AddTransposedProduct(left.rows, left.data.data(), left.stride, left.columns,
                             right.data.data(), right.stride, right.columns, precision,
                             out->data.data(), out->stride, &workspace);
}

constexpr Precision kPrecisions[] = {Precision::kFloat32, Precision::kBfloat16, Precision::kTiles,
                                     Precision::kSplitTiles};

/// A sum in double precision, and the same of magnitudes.
struct Sum {
  void Add(double x) {
    value += x;
    magnitude += std::abs(x);
  }
  double value = 0, magnitude = 0;
};

constexpr Tolerance kUnitRoundoff{0x1p-24, "float32 rounding of one operation"};

/// Adds the product of two elements, and returns how many products of operands that is.
int AddProduct(float a, float b, Precision precision, Sum* sum) {
  const auto rounded = [](float x) -> double { return Bfloat16Value(RoundToBfloat16(x)); };
  if (precision == Precision::kFloat32) {
    sum->Add(static_cast<double>(a) * b);
    return 1;
  }
  sum->Add(rounded(a) * rounded(b));
  if (precision != Precision::kSplitTiles) return 1;
  const auto lacking = [&](float x) { return rounded(static_cast<float>(x - rounded(x))); };
  sum->Add(rounded(a) * lacking(b));
  sum->Add(lacking(a) * rounded(b));
  return 3;
}

/// A float32 sum of `terms` terms, in any order, is off by no more than this (Higham, Accuracy and
/// Stability of Numerical Algorithms, section 3.1), with a rounding for each product, too.
double Bound(const Sum& sum, std::int64_t terms) {
  return 1.01 * static_cast<double>(terms + 2) * kUnitRoundoff * sum.magnitude;
}

void ExpectUntouchedBetweenRows(const Matrix& matrix) {
  for (std::int64_t i = 0; i < matrix.rows; ++i) {
    for (std::int64_t j = matrix.columns; j < matrix.stride; ++j) {
      ASSERT_EQ(matrix.data[i * matrix.stride + j], kBetweenRows) << "row " << i;
    }
  }
}

bool SameBits(const Matrix& a, const Matrix& b) {
  return a.data.size() == b.data.size() &&
         std::memcmp(a.data.data(), b.data.data(), a.data.size() * sizeof(float)) == 0;
}

struct Shape {
  std::int64_t rows, depth, columns;
};

// Heads and observations; every edge of tiles (up to 16 rows), of panels (up to 64 columns) and of
// blocks (384 of depth, 96 rows, 48 rows of a transposed product).
const Shape kShapes[] = {{1, 1, 1},     {3, 2, 5},     {48, 22, 128},  {17, 128, 4},  {97, 128, 1},
                         {13, 4, 37},   {7, 127, 33},  {5, 385, 64},   {100, 9, 130}, {11, 770, 17},
                         {31, 128, 22}, {6, 81, 96},   {191, 16, 48},  {2, 160, 384}, {29, 33, 65},
                         {15, 6, 200},  {8, 1024, 20}, {161, 3, 1024}, {4, 5, 16}};

class MatrixProductTest : public testing::TestWithParam<std::tuple<Target, Precision>> {
 protected:
  Precision precision() const { return std::get<1>(GetParam()); }

 private:
  const ScopedTarget target_{std::get<0>(GetParam())};
};

TEST_P(MatrixProductTest, MultiplyIsTheSumInDoublePrecision) {
  for (const Shape& shape : kShapes) {
    SCOPED_TRACE(testing::Message()
                 << shape.rows << " x " << shape.depth << " x " << shape.columns);
    const Matrix a = Random(shape.rows, shape.depth, 1), b = Random(shape.depth, shape.columns, 2);
    const Matrix bias = Random(1, shape.columns, 3);
    const Matrix before = Random(shape.rows, shape.columns, 4);
    const PackedMatrix packed = Packed(b, precision());
    for (const bool biased : {false, true}) {
      for (const std::int64_t accumulated : {std::int64_t{0}, shape.columns / 2, shape.columns}) {
        Matrix out = before;
        Multiply(a, packed, biased ? bias.data.data() : nullptr, accumulated, &out);
        ExpectUntouchedBetweenRows(out);
        for (std::int64_t i = 0; i < shape.rows; ++i) {
          for (std::int64_t j = 0; j < shape.columns; ++j) {
            Sum sum;
            if (j < accumulated) {
              sum.Add(before.At(i, j));
            } else if (biased) {
              sum.Add(bias.At(0, j));
            }
            std::int64_t terms = 2;
            for (std::int64_t k = 0; k < shape.depth; ++k) {
              terms += AddProduct(a.At(i, k), b.At(k, j), precision(), &sum);
            }
            ASSERT_NEAR(out.At(i, j), sum.value, Bound(sum, terms)) << "at " << i << ", " << j;
          }
        }
      }
    }
  }
}

TEST_P(MatrixProductTest, AddTransposedProductIsTheSumInDoublePrecision) {
  for (const Shape& shape : kShapes) {
    SCOPED_TRACE(testing::Message()
                 << shape.rows << " rows of " << shape.depth << " and " << shape.columns);
    const Matrix left = Random(shape.rows, shape.depth, 1);
    const Matrix right = Random(shape.rows, shape.columns, 2);
    const Matrix before = Random(shape.depth, shape.columns, 3);
    Matrix out = before;
    AddTransposedProduct(left, right, precision(), &out);
    ExpectUntouchedBetweenRows(out);
    for (std::int64_t i = 0; i < shape.depth; ++i) {
      for (std::int64_t j = 0; j < shape.columns; ++j) {
        Sum sum;
        sum.Add(before.At(i, j));
        std::int64_t terms = 1;
        for (std::int64_t r = 0; r < shape.rows; ++r) {
          terms += AddProduct(left.At(r, i), right.At(r, j), precision(), &sum);
        }
        ASSERT_NEAR(out.At(i, j), sum.value, Bound(sum, terms)) << "at " << i << ", " << j;
      }
    }
  }
}

TEST_P(MatrixProductTest, TransposedMatrixPacksByItsStrides) {
  const Matrix b = Random(130, 70, 1), a = Random(9, 130, 2);
  Matrix transposed(70, 130, 5);
  for (std::int64_t k = 0; k < 130; ++k) {
    for (std::int64_t j = 0; j < 70; ++j) transposed.At(j, k) = b.At(k, j);
  }
  PackedMatrix packed;
  packed.Pack(130, 70, transposed.data.data(), 1, transposed.stride, precision());
  Matrix expected(9, 70), out(9, 70);
  Multiply(a, Packed(b, precision()), nullptr, 0, &expected);
  Multiply(a, packed, nullptr, 0, &out);
  EXPECT_TRUE(SameBits(out, expected));
}

TEST_P(MatrixProductTest, PackingAgainForgetsWhatWasPackedBefore) {
  const Matrix large = Random(200, 90, 1), small = Random(7, 5, 2), a = Random(4, 7, 3);
  PackedMatrix packed = Packed(large, precision());
  packed.Pack(7, 5, small.data.data(), small.stride, 1, precision());
  EXPECT_EQ(packed.depth(), 7);
  EXPECT_EQ(packed.columns(), 5);
  Matrix expected(4, 5), out(4, 5);
  Multiply(a, Packed(small, precision()), nullptr, 0, &expected);
  Multiply(a, packed, nullptr, 0, &out);
  EXPECT_TRUE(SameBits(out, expected));
}

TEST_P(MatrixProductTest, DividingRowsAmongCallsChangesNoBit) {
  const std::int64_t rows = 230, depth = 450, columns = 75, accumulated = 30;
  const Matrix a = Random(rows, depth, 1), b = Random(depth, columns, 2);
  const Matrix bias = Random(1, columns, 3), before = Random(rows, columns, 4);
  const PackedMatrix packed = Packed(b, precision());
  Matrix whole = before;
  Multiply(a, packed, bias.data.data(), accumulated, &whole);
  for (const std::int64_t part : {1, 5, 13, 48, 97}) {
    Matrix out = before;
    ProductWorkspace workspace;
    for (std::int64_t row = 0; row < rows; row += part) {
      simd::Multiply(std::min(part, rows - row), &a.data[row * a.stride], a.stride, packed,
                     bias.data.data(), accumulated, &out.data[row * out.stride], out.stride,
                     &workspace);
    }
    EXPECT_TRUE(SameBits(out, whole)) << part << " rows a call";
  }
}

TEST_P(MatrixProductTest, DividingRowsOfATransposedProductChangesNoBit) {
  const std::int64_t rows = 333, depth = 39, columns = 75;
  const Matrix left = Random(rows, depth, 1), right = Random(rows, columns, 2);
  const Matrix before = Random(depth, columns, 3);
  Matrix whole = before;
  AddTransposedProduct(left, right, precision(), &whole);
  const std::vector<std::int64_t> parts = IsOfTiles(precision())
                                              ? std::vector<std::int64_t>{32, 96, 160, 320}
                                              : std::vector<std::int64_t>{2, 14, 80, 162, 332};
  for (const std::int64_t part : parts) {
    Matrix out = before;
    ProductWorkspace workspace;
    for (std::int64_t row = 0; row < rows; row += part) {
      simd::AddTransposedProduct(std::min(part, rows - row), &left.data[row * left.stride],
                                 left.stride, depth, &right.data[row * right.stride], right.stride,
                                 columns, precision(), out.data.data(), out.stride, &workspace);
    }
    EXPECT_TRUE(SameBits(out, whole)) << part << " rows a call";
  }
}

TEST_P(MatrixProductTest, NotFiniteInputsReachWhatDependsOnThemAndNothingElse) {
  // Odd sizes: every kind of padding lies beside the values.
  const std::int64_t rows = 21, depth = 35, columns = 41;
  for (const float poison : {kNan, kInfinity, -kInfinity}) {
    Matrix a = Random(rows, depth, 1), b = Random(depth, columns, 2);
    a.At(rows - 1, depth - 1) = poison;
    Matrix out(rows, columns);
    Multiply(a, Packed(b, precision()), nullptr, 0, &out);
    for (std::int64_t i = 0; i < rows; ++i) {
      for (std::int64_t j = 0; j < columns; ++j) {
        ASSERT_EQ(std::isfinite(out.At(i, j)), i != rows - 1) << i << ", " << j;
      }
    }
    a = Random(rows, depth, 1);
    b.At(depth - 1, columns - 1) = poison;
    Multiply(a, Packed(b, precision()), nullptr, 0, &out);
    for (std::int64_t i = 0; i < rows; ++i) {
      for (std::int64_t j = 0; j < columns; ++j) {
        ASSERT_EQ(std::isfinite(out.At(i, j)), j != columns - 1) << i << ", " << j;
      }
    }
    Matrix left = Random(rows, depth, 3), right = Random(rows, columns, 4);
    left.At(rows - 1, depth - 1) = poison;
    Matrix gradient = Random(depth, columns, 5);
    AddTransposedProduct(left, right, precision(), &gradient);
    for (std::int64_t i = 0; i < depth; ++i) {
      for (std::int64_t j = 0; j < columns; ++j) {
        ASSERT_EQ(std::isfinite(gradient.At(i, j)), i != depth - 1) << i << ", " << j;
      }
    }
    left = Random(rows, depth, 3);
    right.At(rows - 1, columns - 1) = poison;
    gradient = Random(depth, columns, 5);
    AddTransposedProduct(left, right, precision(), &gradient);
    for (std::int64_t i = 0; i < depth; ++i) {
      for (std::int64_t j = 0; j < columns; ++j) {
        ASSERT_EQ(std::isfinite(gradient.At(i, j)), j != columns - 1) << i << ", " << j;
      }
    }
  }
}

TEST_P(MatrixProductTest, NoRowsDoNothing) {
  const PackedMatrix packed = Packed(Random(4, 4, 1), precision());
  Matrix out = Random(1, 4, 2);
  const Matrix before = out;
  ProductWorkspace workspace;
  simd::Multiply(0, nullptr, 4, packed, nullptr, 0, out.data.data(), 4, &workspace);
  simd::AddTransposedProduct(0, nullptr, 1, 1, nullptr, 4, 4, precision(), out.data.data(), 4,
                             &workspace);
  EXPECT_TRUE(SameBits(out, before));
}

TEST_P(MatrixProductTest, FetchingMemoryChangesNoBit) {
  const Matrix a = Random(97, 70, 1), b = Random(70, 130, 2), right = Random(97, 130, 3);
  const PackedMatrix packed = Packed(b, precision());
  Matrix expected(97, 130), out(97, 130), expected_gradient(70, 130), gradient(70, 130);
  Multiply(a, packed, nullptr, 0, &expected);
  AddTransposedProduct(a, right, precision(), &expected_gradient);

  const std::vector<float> memory(5000);
  ProductWorkspace workspace;
  workspace.FetchSoon(memory.data(), 1000);
  workspace.FetchSoon(memory.data() + 3000, 2000);
  simd::Multiply(a.rows, a.data.data(), a.stride, packed, nullptr, 0, out.data.data(), out.stride,
                 &workspace);
  simd::AddTransposedProduct(a.rows, a.data.data(), a.stride, a.columns, right.data.data(),
                             right.stride, right.columns, precision(), gradient.data.data(),
                             gradient.stride, &workspace);
  EXPECT_TRUE(SameBits(out, expected));
  EXPECT_TRUE(SameBits(gradient, expected_gradient));
  // There were more words of depth than lines.
  const FetchRange* const left = workspace.NextFetch();
  EXPECT_GE(left->next, left->end);
}

TEST(ProductWorkspaceTest, FetchesInTheOrderAskedForAndForgetsTheOldest) {
  constexpr auto kMost = static_cast<std::int64_t>(ProductWorkspace::kMostFetches);
  const std::vector<float> memory(2 * kMost);
  ProductWorkspace workspace;
  EXPECT_EQ(workspace.NextFetch()->next, workspace.NextFetch()->end);
  for (std::int64_t i = 0; i < kMost + 3; ++i) workspace.FetchSoon(&memory[i], 1);
  for (std::int64_t i = 3; i < kMost + 3; ++i) {
    FetchRange* const range = workspace.NextFetch();
    EXPECT_EQ(range->next, reinterpret_cast<const char*>(&memory[i]));
    EXPECT_EQ(range->end - range->next, static_cast<std::ptrdiff_t>(sizeof(float)));
    range->next = range->end;
  }
  EXPECT_EQ(workspace.NextFetch()->next, workspace.NextFetch()->end);
}

class RoundedProductTest : public testing::TestWithParam<std::tuple<Target, Precision>> {
 protected:
  Precision precision() const { return std::get<1>(GetParam()); }

 private:
  const ScopedTarget target_{std::get<0>(GetParam())};
};

TEST_P(RoundedProductTest, OperandsAreRoundedAsStated) {
  // Every exponent, ties among them; the products by one show what each operand became.
  std::vector<float> values = {
      0.0f,          -0.0f,           1.0f,      0x1.01p0f,        0x1.03p0f,
      0x1.02fffep0f, -0x1p0f,         0x1p-126f, 0x1.fffffcp-127f, 0x1p-149f,
      -0x1p-130f,    0x1.fffffep127f, kNan,      kInfinity,        -kInfinity};
  std::mt19937 generator(1);
  while (values.size() < 300) {
    const std::uint32_t bits = generator();
    float value;
    std::memcpy(&value, &bits, sizeof value);
    values.push_back(value);
  }
  const auto expect_rounded = [](float result, float value) {
    const float expected = Bfloat16Value(RoundToBfloat16(value));
    if (std::isnan(expected)) {
      EXPECT_TRUE(std::isnan(result));
    } else {
      EXPECT_EQ(result, expected) << value;
    }
  };
  const auto count = static_cast<std::int64_t>(values.size());
  Matrix one(1, 1), column(count, 1, 0), row(1, count, 0);
  one.At(0, 0) = 1;
  column.data = row.data = values;
  Matrix out(count, 1, 0);
  Multiply(column, Packed(one, precision()), nullptr, 0, &out);
  for (std::int64_t i = 0; i < count; ++i) expect_rounded(out.At(i, 0), values[i]);
  Matrix across(1, count, 0);
  Multiply(one, Packed(row, precision()), nullptr, 0, &across);
  for (std::int64_t i = 0; i < count; ++i) expect_rounded(across.At(0, i), values[i]);
  std::fill(across.data.begin(), across.data.end(), 0.0f);
  AddTransposedProduct(one, row, precision(), &across);
  for (std::int64_t i = 0; i < count; ++i) expect_rounded(across.At(0, i), values[i]);
}

TEST_P(RoundedProductTest, SumsRunInTheOrderStated) {
  // 2^24 + 1 is 2^24 in float32: added odd element first, the one is lost, and is not where even
  // and odd elements are added apart.
  const float large = 0x1p24f;
  const float expected = IsOfTiles(precision()) ? 1 : 0;
  Matrix a(1, 2), b(2, 1), bias(1, 1), out(1, 1);
  a.At(0, 0) = -large;
  a.At(0, 1) = b.At(0, 0) = b.At(1, 0) = 1;
  bias.At(0, 0) = large;
  Multiply(a, Packed(b, precision()), bias.data.data(), 0, &out);
  EXPECT_EQ(out.At(0, 0), expected);
  Matrix left(2, 1);
  left.At(0, 0) = -large;
  left.At(1, 0) = 1;
  out.At(0, 0) = large;
  AddTransposedProduct(left, b, precision(), &out);
  EXPECT_EQ(out.At(0, 0), expected);
}

TEST_P(RoundedProductTest, SumsOfTilesRunBlockByBlock) {
  if (!IsOfTiles(precision())) GTEST_SKIP() << "sums of pairs have no blocks";
  // 33 elements of one, the last of them in a block of its own, and 2^24 in the first block.
  Matrix a(1, 33), b(33, 1), out(1, 1);
  for (std::int64_t k = 0; k < 33; ++k) a.At(0, k) = b.At(k, 0) = 1;
  a.At(0, 0) = 0x1p24f;
  Multiply(a, Packed(b, precision()), nullptr, 0, &out);
  // Of the even elements each one is lost, of the odd ones there are 16, and the last is lost.
  EXPECT_EQ(out.At(0, 0), 0x1p24f + 16);
}

std::string ParameterName(const testing::TestParamInfo<std::tuple<Target, Precision>>& test) {
  const char* const names[] = {"_float32", "_bfloat16", "_tiles", "_split_tiles"};
  return Name(std::get<0>(test.param)) +
         std::string(names[static_cast<int>(std::get<1>(test.param))]);
}

/// Of whole numbers, as the normal distribution's are not the same in every standard library.
Matrix RandomOnEveryMachine(std::int64_t rows, std::int64_t columns, unsigned seed) {
  std::mt19937 generator(seed);
  Matrix matrix(rows, columns);
  for (float& x : matrix.data) x = static_cast<float>(generator()) * 0x1p-32f - 0.5f;
  return matrix;
}

/// x86-64 and AArch64, any lanes. Products of bfloat16 are exact in float32.
TEST_P(MatrixProductTest, BitsDependOnWhetherMultiplyAddsRoundOnceAlone) {
  const Matrix a = RandomOnEveryMachine(65, 71, 1), b = RandomOnEveryMachine(71, 37, 2);
  Matrix product(65, 37), gradient = b;
  Multiply(a, Packed(b, precision()), nullptr, 0, &product);
  AddTransposedProduct(a, product, precision(), &gradient);
  FnvHash hash;
  for (const Matrix* matrix : {&product, &gradient}) {
    hash.Add(matrix->data.data(), matrix->data.size() * sizeof(float));
  }
  switch (precision()) {
    case Precision::kFloat32:
      EXPECT_EQ(hash.Hex(),
                FusesMultiplyAdd(ActiveTarget()) ? "d97fa330c2870d95" : "85c61b094f729a1d");
      break;
    case Precision::kBfloat16:
      EXPECT_EQ(hash.Hex(), "b09b4b0e95bec95e");
      break;
    case Precision::kTiles:
      EXPECT_EQ(hash.Hex(), "837a088df5fde8d9");
      break;
    case Precision::kSplitTiles:
      EXPECT_EQ(hash.Hex(), "43ff37e2ea453524");
      break;
  }
}

INSTANTIATE_TEST_SUITE_P(EveryTarget, MatrixProductTest,
                         testing::Combine(testing::ValuesIn(SupportedTargets()),
                                          testing::ValuesIn(kPrecisions)),
                         ParameterName);

INSTANTIATE_TEST_SUITE_P(EveryTarget, RoundedProductTest,
                         testing::Combine(testing::ValuesIn(SupportedTargets()),
                                          testing::Values(Precision::kBfloat16, Precision::kTiles)),
                         ParameterName);

/// On processors with the instructions for bfloat16 this compares them with what stands in for
/// them.
TEST(MatrixProduct, TargetsWithFusedMultiplyAddsAgreeBitForBit) {
  const auto supported = SupportedTargets();
  for (const Target target : {Target::kAvx512, Target::kAvx2}) {
    if (std::find(supported.begin(), supported.end(), target) == supported.end()) {
      GTEST_SKIP() << "one of the targets is not supported";
    }
  }
  for (const Precision precision : kPrecisions) {
    for (const Shape& shape : kShapes) {
      const Matrix a = Random(shape.rows, shape.depth, 1);
      const Matrix b = Random(shape.depth, shape.columns, 2);
      const Matrix right = Random(shape.rows, shape.columns, 3);
      std::vector<Matrix> products, gradients;
      for (const Target target : {Target::kAvx512, Target::kAvx2}) {
        const ScopedTarget scoped(target);
        products.emplace_back(shape.rows, shape.columns);
        Multiply(a, Packed(b, precision), nullptr, 0, &products.back());
        gradients.push_back(b);
        AddTransposedProduct(a, right, precision, &gradients.back());
      }
      EXPECT_TRUE(SameBits(products[0], products[1]));
      EXPECT_TRUE(SameBits(gradients[0], gradients[1]));
    }
  }
}

TEST(MatrixProduct, MatrixOfAnotherTargetIsAnError) {
  const auto packed_for = [](Target target) {
    const ScopedTarget scoped(target);
    return Packed(Random(4, 4, 1), Precision::kFloat32);
  };
  const PackedMatrix packed = packed_for(SupportedTargets().front());
  const Matrix a = Random(2, 4, 2);
  Matrix out(2, 4);
  if (SupportedTargets().size() > 1) {
    const ScopedTarget scoped(SupportedTargets().back());
    EXPECT_THROW(Multiply(a, packed, nullptr, 0, &out), Error);
  }
  EXPECT_THROW(Multiply(a, PackedMatrix(), nullptr, 0, &out), Error);
}

TEST(MatrixProduct, EmptyMatrixIsAnError) {
  PackedMatrix packed;
  const float data[1] = {};
  EXPECT_THROW(packed.Pack(0, 1, data, 1, 1, Precision::kFloat32), Error);
  EXPECT_THROW(packed.Pack(1, 0, data, 1, 1, Precision::kFloat32), Error);
}

TEST(MatrixProduct, MatrixWithoutContiguousRowsOrColumnsIsAnError) {
  PackedMatrix packed;
  const float data[4] = {};
  EXPECT_THROW(packed.Pack(1, 2, data, 2, 2, Precision::kFloat32), Error);
}

TEST(Bfloat16, RoundsToNearestEven) {
  // A bfloat16 has 8 significant bits: neighbours of one are 2^-7 apart.
  EXPECT_EQ(Bfloat16Value(RoundToBfloat16(1.0f + 0x1p-8f)), 1.0f);
  EXPECT_EQ(Bfloat16Value(RoundToBfloat16(1.0f + 3 * 0x1p-8f)), 1.0f + 4 * 0x1p-8f);
  EXPECT_EQ(Bfloat16Value(RoundToBfloat16(1.0f + 0x1.01p-8f)), 1.0f + 0x1p-7f);
  EXPECT_EQ(Bfloat16Value(RoundToBfloat16(std::numeric_limits<float>::max())), kInfinity);
  EXPECT_EQ(Bfloat16Value(RoundToBfloat16(-kInfinity)), -kInfinity);
  EXPECT_TRUE(std::isnan(Bfloat16Value(RoundToBfloat16(kNan))));
  const float denormal = Bfloat16Value(RoundToBfloat16(-0x1p-127f));
  EXPECT_EQ(denormal, 0);
  EXPECT_TRUE(std::signbit(denormal));
}

}  // namespace
}  // namespace skein::simd
