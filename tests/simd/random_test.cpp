// SPDX-License-Identifier: Apache-2.0
#include "simd/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "simd/target.h"
#include "tests/tolerance.h"

namespace skein::simd {
namespace {

// Known answers of Random123 (kat_vectors, philox4x32 with 10 rounds).
TEST(Philox4x32, GivesPublishedKnownAnswers) {
  using Words = std::array<std::uint32_t, 4>;
  EXPECT_EQ(Philox4x32({0, 0, 0, 0}, {0, 0}),
            (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  constexpr std::uint32_t kOnes = 0xffffffff;
  EXPECT_EQ(Philox4x32({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}),
            (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(Philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

// All 64 bits of a seed count.
constexpr std::uint64_t kWideSeed = 0x123456789abcdef0;

TEST(RandomWords, AreThoseOfTheCounterUnderBothHalvesOfTheSeed) {
  const RandomKey key{kWideSeed, 7, 8, 9, RandomPurpose::kTarget};
  for (const std::uint32_t block : {0u, 1u, 0xffffffu}) {
    const std::uint32_t last = static_cast<std::uint32_t>(RandomPurpose::kTarget) | block << 8;
    EXPECT_EQ(RandomWords(key, block), Philox4x32({7, 8, 9, last}, {0x9abcdef0, 0x12345678}));
  }
}

TEST(RandomStream, DrawsTheWordsOfItsBlocksInOrder) {
  const RandomKey key{kWideSeed, 7, 8, 9, RandomPurpose::kTarget};
  RandomStream stream(key);
  for (std::uint32_t block = 0; block < 3; ++block) {
    for (const std::uint32_t word : RandomWords(key, block)) EXPECT_EQ(stream.Word(), word);
  }
}

TEST(RandomStream, UniformsFillTheUnitInterval) {
  RandomStream stream({1, 2, 3, 4, RandomPurpose::kInitialState});
  constexpr int kCount = 100000;
  double sum = 0, squares = 0, least = 1, most = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = stream.Uniform();
    sum += x;
    squares += x * x;
    least = std::min(least, x);
    most = std::max(most, x);
  }
  EXPECT_NEAR(sum / kCount, 1.0 / 2, kStandardErrors * std::sqrt(1.0 / 12 / kCount));
  EXPECT_NEAR(squares / kCount, 1.0 / 3, kStandardErrors * std::sqrt(4.0 / 45 / kCount));
  EXPECT_GE(least, 0);
  EXPECT_LT(most, 1);
  EXPECT_LT(least, 1e-3);
  EXPECT_GT(most, 1 - 1e-3);
}

class FillNormalsTest : public testing::TestWithParam<Target> {
 protected:
  void SetUp() override {
    previous_ = ActiveTarget();
    ForceTarget(GetParam());
  }
  void TearDown() override { ForceTarget(previous_); }

  // Row i has the key (seed, first + i, 5, c).
  static std::vector<float> Draw(std::uint64_t seed, std::uint32_t first, int count, int size,
                                 std::uint32_t c = 11) {
    const std::vector<std::uint32_t> b(static_cast<std::size_t>(count), 5),
        steps(static_cast<std::size_t>(count), c);
    std::vector<float> normals(static_cast<std::size_t>(count) * size);
    FillNormals(seed, first, b.data(), steps.data(), RandomPurpose::kObservationNoise, count, size,
                normals.data());
    return normals;
  }

 private:
  Target previous_{};
};

/// The `j`-th normal deviate of a key by Box and Muller in double precision.
double Normal(const RandomKey& key, int j) {
  const auto words = RandomWords(key, static_cast<std::uint32_t>(j / 4));
  const std::uint32_t radius_word = words[j % 4 < 2 ? 0 : 2];
  const std::uint32_t angle_word = words[j % 4 < 2 ? 1 : 3];
  const double radius = std::sqrt(-2 * std::log(((radius_word >> 8) + 1) * 0x1.0p-24));
  const double in_quadrant = static_cast<std::int32_t>(angle_word << 2) * 0x1.0p-31;
  const double angle = M_PI / 2 * (angle_word >> 30) + M_PI / 4 * in_quadrant;
  return radius * (j % 2 == 0 ? std::cos(angle) : std::sin(angle));
}

TEST_P(FillNormalsTest, AppliesBoxMullerToTheScalarWordsOfEachRowsKey) {
  constexpr Tolerance kFloat32{2e-6, "logarithm, sine and cosine in float32, times up to 5.8"};
  constexpr int kCount = 37, kSize = 22;
  constexpr std::uint32_t kFirst = 1000;
  std::vector<std::uint32_t> b, c;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    b.push_back(5 + i);
    c.push_back(11 + 3 * i);
  }
  for (const RandomPurpose purpose :
       {RandomPurpose::kObservationNoise, RandomPurpose::kActionNoise}) {
    std::vector<float> normals(kCount * kSize);
    FillNormals(kWideSeed, kFirst, b.data(), c.data(), purpose, kCount, kSize, normals.data());
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const RandomKey key{kWideSeed, kFirst + i, b[i], c[i], purpose};
      for (int j = 0; j < kSize; ++j) {
        EXPECT_NEAR(normals[i * kSize + static_cast<std::size_t>(j)], Normal(key, j), kFloat32);
      }
    }
  }
}

TEST_P(FillNormalsTest, HasTheMomentsAndTailsOfANormal) {
  constexpr int kCount = 20000, kSize = 22;
  const std::vector<float> normals = Draw(3, 0, kCount, kSize);
  const double n = static_cast<double>(normals.size());
  double sum[5] = {};
  double beyond2 = 0, beyond4 = 0, most = 0;
  for (const float x : normals) {
    double power = 1;
    for (double& s : sum) {
      s += power;
      power *= x;
    }
    beyond2 += std::abs(x) > 2;
    beyond4 += std::abs(x) > 4;
    most = std::max(most, std::abs(static_cast<double>(x)));
  }
  // The variances of x, x^2, x^3, x^4 are 1, 2, 15, 96.
  EXPECT_NEAR(sum[1] / n, 0, kStandardErrors * std::sqrt(1 / n));
  EXPECT_NEAR(sum[2] / n, 1, kStandardErrors * std::sqrt(2 / n));
  EXPECT_NEAR(sum[3] / n, 0, kStandardErrors * std::sqrt(15 / n));
  EXPECT_NEAR(sum[4] / n, 3, kStandardErrors * std::sqrt(96 / n));
  const double tail2 = std::erfc(2 / std::sqrt(2.0)), tail4 = std::erfc(4 / std::sqrt(2.0));
  EXPECT_NEAR(beyond2 / n, tail2, kStandardErrors * std::sqrt(tail2 / n));
  EXPECT_NEAR(beyond4 / n, tail4, kStandardErrors * std::sqrt(tail4 / n));
  EXPECT_LE(most, 5.78);
}

double Correlation(const std::vector<float>& x, const std::vector<float>& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += static_cast<double>(x[i]) * y[i];
  return sum / static_cast<double>(x.size());
}

TEST_P(FillNormalsTest, DifferentKeysAreUncorrelated) {
  constexpr int kCount = 5000, kSize = 20;
  const std::vector<float> base = Draw(1, 0, kCount, kSize);
  const double bound = kStandardErrors / std::sqrt(static_cast<double>(base.size()));
  EXPECT_NEAR(Correlation(base, Draw(2, 0, kCount, kSize)), 0, bound);
  constexpr std::uint64_t kOtherUpperHalf = 1 + (std::uint64_t{1} << 32);
  EXPECT_NEAR(Correlation(base, Draw(kOtherUpperHalf, 0, kCount, kSize)), 0, bound);
  EXPECT_NEAR(Correlation(base, Draw(1, kCount, kCount, kSize)), 0, bound);
  EXPECT_NEAR(Correlation(base, Draw(1, 0, kCount, kSize, 12)), 0, bound);
  // Neighbouring elements: cosine and sine of one pair, and across pairs.
  std::vector<float> shifted(base.begin() + 1, base.end());
  shifted.push_back(base.front());
  EXPECT_NEAR(Correlation(base, shifted), 0, bound);
}

TEST_P(FillNormalsTest, DependsOnlyOnTheKey) {
  constexpr int kSize = 22;
  const std::vector<float> all = Draw(4, 0, 100, kSize);
  for (const int first : {0, 1, 17, 63}) {
    const std::vector<float> part = Draw(4, static_cast<std::uint32_t>(first), 21, kSize);
    EXPECT_TRUE(std::equal(part.begin(), part.end(),
                           all.begin() + static_cast<std::ptrdiff_t>(first) * kSize));
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, FillNormalsTest, testing::ValuesIn(SupportedTargets()),
                         [](const auto& test) { return std::string(Name(test.param)); });

}  // namespace
}  // namespace skein::simd
