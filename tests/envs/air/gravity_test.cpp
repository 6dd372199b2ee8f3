// SPDX-License-Identifier: Apache-2.0
#include "envs/air/gravity.h"

#include <gtest/gtest.h>

#include "tests/tolerance.h"

namespace skein {
namespace {

TEST(Gravity, IsTheSameEverywhereUnlessAskedFor) {
  const Gravity gravity;
  EXPECT_EQ(gravity.At(0), kGravityFtS2);
  EXPECT_EQ(gravity.At(50000), kGravityFtS2);
}

// U.S. Standard Atmosphere 1976, table I: g at 0, 5, 11 and 20 km of geometric altitude, m/s^2.
TEST(Gravity, FallsAsTheStandardAtmosphereHasIt) {
  constexpr Tolerance kPublishedDigits{5e-5, "digits of the table, m/s^2"};
  const Gravity gravity{9.80665 / 0.3048, true};
  const struct {
    double altitude_m, gravity_m_s2;
  } rows[] = {{0, 9.80665}, {5000, 9.79124}, {11000, 9.77280}, {20000, 9.74522}};
  for (const auto& row : rows) {
    EXPECT_NEAR(gravity.At(row.altitude_m / 0.3048) * 0.3048, row.gravity_m_s2, kPublishedDigits)
        << row.altitude_m;
  }
}

}  // namespace
}  // namespace skein
