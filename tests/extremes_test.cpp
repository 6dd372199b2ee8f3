// SPDX-License-Identifier: Apache-2.0
#include "tests/extremes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace skein {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Extremes, AreThoseOfNumbers) {
  EXPECT_EQ(Larger(1.0, -2.0), 1);
  EXPECT_EQ(Larger(-2.0f, 1.0f), 1);
  EXPECT_EQ(Smaller(1.0, -2.0), -2);
  EXPECT_EQ(Smaller(-2.0f, 1.0f), -2);
  EXPECT_EQ(LargestOf(std::vector<double>{-3, -1, -2}), -1);
}

TEST(Extremes, NaNIsBeyondAllNumbersAndStays) {
  const double nan = std::nan("");
  EXPECT_EQ(Larger(1.0, nan), kInfinity);
  EXPECT_EQ(Larger(nan, 1.0), kInfinity);
  EXPECT_EQ(Larger(Larger(1.0, nan), 2.0), kInfinity);
  EXPECT_EQ(Smaller(1.0, nan), -kInfinity);
  EXPECT_EQ(Smaller(nan, 1.0), -kInfinity);
  for (const std::vector<double>& values :
       {std::vector<double>{nan, 1}, {1, nan}, {nan}, {1, nan, 2}}) {
    EXPECT_EQ(LargestOf(values), kInfinity);
  }
}

}  // namespace
}  // namespace skein
