// SPDX-License-Identifier: Apache-2.0
#include "tests/tolerance.h"

#include <gtest/gtest.h>

#include <sstream>

namespace skein {
namespace {

constexpr Tolerance kRounding{0.25, "rounding"};

// Run by ctest with other scales, too: this fails with those below 1, and shows the residual.
TEST(Tolerance, HoldsWhatItsValueAllows) {
  EXPECT_NEAR(1.2, 1, kRounding);
  EXPECT_LT(0.2, kRounding);
}

TEST(Tolerance, IsPrintedWithItsReason) {
  std::ostringstream printed, expected;
  printed << kRounding;
  expected << 0.25 * ToleranceScale() << " (rounding)";
  EXPECT_EQ(printed.str(), expected.str());
}

}  // namespace
}  // namespace skein
