// SPDX-License-Identifier: Apache-2.0
#include "base/denormals.h"

#include <gtest/gtest.h>

#include <limits>

namespace skein {
namespace {

constexpr float kSmallestNormal = std::numeric_limits<float>::min();

/// Volatile, so that the processor computes it, in the mode of the moment.
float Product(float a, float b) {
  volatile float x = a, y = b;
  volatile float product = x * y;
  return product;
}

class DenormalsFlushedTest : public testing::Test {
 protected:
  void SetUp() override {
    if (float_modes::kFlushDenormals == 0) GTEST_SKIP() << "denormals stay on this processor";
  }
};

TEST_F(DenormalsFlushedTest, ResultsAreZeroWhileItLives) {
  {
    const DenormalsFlushed flushed;
    EXPECT_EQ(Product(kSmallestNormal, 0.5f), 0);
    EXPECT_EQ(Product(kSmallestNormal, 1), kSmallestNormal);
  }
  EXPECT_EQ(Product(kSmallestNormal, 0.5f), kSmallestNormal / 2);
}

TEST_F(DenormalsFlushedTest, OperandsAreZeroWhileItLives) {
  const float denormal = Product(kSmallestNormal, 0.5f);
  {
    const DenormalsFlushed flushed;
    EXPECT_EQ(Product(denormal, 4), 0);
  }
  EXPECT_EQ(Product(denormal, 4), 2 * kSmallestNormal);
}

TEST_F(DenormalsFlushedTest, AnInnerOneLeavesTheOuterOnesMode) {
  const DenormalsFlushed outer;
  { const DenormalsFlushed inner; }
  EXPECT_EQ(Product(kSmallestNormal, 0.5f), 0);
}

}  // namespace
}  // namespace skein
