// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/clipped_step.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr Tolerance kRounding{1e-6, "float32 products of numbers of order one"};
constexpr double kLearningRate = 0.1, kEpsilon = 1e-8;

/// Adam with the gradient (6, 8), whose norm is 10, on parameters of 1.
AdamOptimiser WithNormOfTen() {
  AdamOptimiser optimiser({1, 1}, kEpsilon);
  optimiser.gradient()[0] = 6;
  optimiser.gradient()[1] = 8;
  return optimiser;
}

/// What the first step leaves of a gradient: a tenth (Adam's first beta is 0.9).
std::vector<float> FirstMoment(double max_norm) {
  AdamOptimiser optimiser = WithNormOfTen();
  EXPECT_NEAR(ClippedStep(max_norm, kLearningRate, optimiser), 10, kRounding);
  return optimiser.state().first_moment;
}

TEST(ClippedStepTest, ALongGradientKeepsItsDirectionAlone) {
  const std::vector<float> moment = FirstMoment(1);
  EXPECT_NEAR(moment[0], 0.06, kRounding);
  EXPECT_NEAR(moment[1], 0.08, kRounding);
}

TEST(ClippedStepTest, AShorterOneIsTakenAsItIs) {
  const std::vector<float> moment = FirstMoment(11);
  EXPECT_NEAR(moment[0], 0.6, kRounding);
  EXPECT_NEAR(moment[1], 0.8, kRounding);
}

TEST(ClippedStepTest, ParametersMoveByTheLearningRate) {
  // Adam's first step is that far against the gradient, however long that is.
  for (const double learning_rate : {kLearningRate, 2 * kLearningRate}) {
    AdamOptimiser optimiser = WithNormOfTen();
    ClippedStep(1, learning_rate, optimiser);
    for (const float parameter : optimiser.ParameterVector()) {
      EXPECT_NEAR(parameter, 1 - learning_rate, kRounding);
    }
  }
}

TEST(ClippedStepTest, AnExplodedOneChangesNothing) {
  AdamOptimiser optimiser = WithNormOfTen();
  for (const float gradient :
       {std::numeric_limits<float>::quiet_NaN(), static_cast<float>(2 * kExplodedGradientNorm)}) {
    optimiser.gradient()[0] = gradient;
    EXPECT_FALSE(ClippedStep(1, kLearningRate, optimiser) <= kExplodedGradientNorm);
    EXPECT_EQ(optimiser.ParameterVector(), (std::vector<float>{1, 1}));
    EXPECT_EQ(optimiser.state().step, 0);
  }
}

}  // namespace
}  // namespace skein
