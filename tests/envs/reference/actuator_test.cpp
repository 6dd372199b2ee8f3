// SPDX-License-Identifier: Apache-2.0
#include "envs/reference/actuator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kRounding{1e-13, "float64 rounding"};
constexpr Tolerance kSettled{1e-9, "what a lag leaves after 20 s"};
const Actuator kElevator{20.2, 60, -25, 25};

TEST(Actuator, FollowsTheExactLagWhateverTheStep) {
  constexpr double kTime = 0.1;
  for (int steps : {1, 2, 7}) {
    double position = 0;
    for (int i = 0; i < steps; ++i) position = StepActuator(kElevator, position, 2, kTime / steps);
    EXPECT_NEAR(position, 2 * (1 - std::exp(-20.2 * kTime)), kRounding);
  }
}

TEST(Actuator, MovesNoFasterThanItsRateLimit) {
  EXPECT_NEAR(StepActuator(kElevator, 0, 25, 0.02), 1.2, kRounding);
  EXPECT_NEAR(StepActuator(kElevator, 0, -25, 0.02), -1.2, kRounding);
}

TEST(Actuator, StopsAtItsLimits) {
  double position = 0;
  for (int i = 0; i < 1000; ++i) position = StepActuator(kElevator, position, 1e6, 0.02);
  EXPECT_NEAR(position, 25, kSettled);
  EXPECT_EQ(StepActuator(kElevator, 90, 90, 0.02), 25);
}

}  // namespace
}  // namespace skein
