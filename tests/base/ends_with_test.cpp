// SPDX-License-Identifier: Apache-2.0
#include "base/ends_with.h"

#include <gtest/gtest.h>

namespace skein {
namespace {

TEST(EndsWith, ComparesTheLastLetters) {
  EXPECT_TRUE(EndsWith("flights.csv", ".csv"));
  EXPECT_FALSE(EndsWith("flights.csv", ".json"));
  EXPECT_FALSE(EndsWith("flights.csv.gz", ".csv"));
  EXPECT_FALSE(EndsWith("flights.CSV", ".csv"));
}

TEST(EndsWith, KnowsTheEmptyAndTheWholeText) {
  EXPECT_TRUE(EndsWith(".csv", ".csv"));
  EXPECT_FALSE(EndsWith("csv", ".csv"));
  EXPECT_TRUE(EndsWith("csv", ""));
  EXPECT_TRUE(EndsWith("", ""));
}

}  // namespace
}  // namespace skein
