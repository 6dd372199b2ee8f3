// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "envs/autopilot/l1-inl.h"
#include "gtest/gtest.h"
#include "tests/tolerance.h"

namespace skein {
namespace HWY_NAMESPACE {
namespace {

/// Turning at a = V yaw_rate, small errors decay at 2 sqrt(2) pi / period.
TEST(L1, SmallErrorsDecayAtTheRateOfThePeriod) {
  constexpr Tolerance kSmallAngle{1e-8, "an error of 1e-4 rad is not quite small"};
  const L1Gains gains;
  const double rate = TurnToHeading(gains, 1e-4, 1000.0) / 1000 / 1e-4;
  EXPECT_NEAR(rate, 2 * std::sqrt(2) * M_PI / gains.period_s, kSmallAngle);
}

TEST(L1, TurnsTowardsTheHeading) {
  EXPECT_GT(TurnToHeading(L1Gains(), 0.2, 1000.0), 0);
  EXPECT_EQ(TurnToHeading(L1Gains(), -0.2, 1000.0), -TurnToHeading(L1Gains(), 0.2, 1000.0));
  EXPECT_EQ(TurnToHeading(L1Gains(), 0.0, 1000.0), 0);
}

TEST(L1, TurnsAsHardBeyondAQuarterTurnAsAtIt) {
  const double most = TurnToHeading(L1Gains(), M_PI / 2, 1000.0);
  EXPECT_EQ(TurnToHeading(L1Gains(), 3.0, 1000.0), most);
  EXPECT_EQ(TurnToHeading(L1Gains(), -3.0, 1000.0), -most);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace skein
