// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/table_lookup.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kRounding{1e-14, "float64 rounding"};
constexpr Tolerance kProducts{2e-13, "float64 rounding of products in the hundreds"};
const std::vector<double> kAxis = {-2, 0, 1, 4};

TEST(TableLookup, LocatesNodesEndsAndBeyond) {
  EXPECT_EQ(Locate(kAxis, -2).index, 0);
  EXPECT_EQ(Locate(kAxis, 0).index, 1);
  EXPECT_EQ(Locate(kAxis, 0).fraction, 0);
  EXPECT_EQ(Locate(kAxis, 2.5).index, 2);
  EXPECT_NEAR(Locate(kAxis, 2.5).fraction, 0.5, kRounding);
  EXPECT_EQ(Locate(kAxis, 4).index, 2);
  EXPECT_EQ(Locate(kAxis, 4).fraction, 1);
  EXPECT_EQ(Locate(kAxis, 99).fraction, 1);
  EXPECT_EQ(Locate(kAxis, -99).index, 0);
  EXPECT_EQ(Locate(kAxis, -99).fraction, 0);
}

// Multilinear interpolation reproduces every multilinear function, whatever the axes.
TEST(TableLookup, ReproducesMultilinearFunctions) {
  const std::vector<double> ys = {0, 3, 5};
  const std::vector<double> zs = {-1, 1};
  const auto plane = [](double x, double y) { return 1 + 2 * x - y + 0.5 * x * y; };
  const auto space = [&](double x, double y, double z) { return plane(x, y) * (1 - 0.3 * z); };
  std::vector<double> line, two, three;
  for (double x : kAxis) {
    line.push_back(3 - x);
    for (double y : ys) {
      two.push_back(plane(x, y));
      for (double z : zs) three.push_back(space(x, y, z));
    }
  }
  std::mt19937_64 random(1);
  for (int n = 0; n < 200; ++n) {
    const double x = std::uniform_real_distribution<double>(-2, 4)(random);
    const double y = std::uniform_real_distribution<double>(0, 5)(random);
    const double z = std::uniform_real_distribution<double>(-1, 1)(random);
    const GridCell i = Locate(kAxis, x), j = Locate(ys, y), k = Locate(zs, z);
    EXPECT_NEAR(Interpolate(line, i), 3 - x, kRounding);
    EXPECT_NEAR(Interpolate(two, i, j, 3), plane(x, y), kProducts);
    EXPECT_NEAR(Interpolate(three, i, j, 3, k, 2), space(x, y, z), kProducts);
  }
}

}  // namespace
}  // namespace skein
