// SPDX-License-Identifier: Apache-2.0
#include "base/median.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace skein {
namespace {

TEST(Median, IsTheOneInTheMiddleInWhateverOrder) {
  EXPECT_EQ(Median({7}), 7);
  EXPECT_EQ(Median({3, 1, 2}), 2);
  EXPECT_EQ(Median({5, -1, 5, 5, 2}), 5);
}

TEST(Median, OfAnEvenNumberIsTheMeanOfTheTwoInTheMiddle) {
  EXPECT_EQ(Median({4, 1}), 2.5);
  EXPECT_EQ(Median({10, 1, 3, 2}), 2.5);
  EXPECT_EQ(Median({3, 3, 1, 9}), 3);
}

TEST(Median, TakesNoNoticeOfHowFarOutliersLie) {
  EXPECT_EQ(Median({1, 2, std::numeric_limits<double>::infinity()}), 2);
}

TEST(Median, OfNoneIsNotANumber) { EXPECT_TRUE(std::isnan(Median({}))); }

}  // namespace
}  // namespace skein
