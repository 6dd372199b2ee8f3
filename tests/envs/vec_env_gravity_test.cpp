// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "envs/aircraft/aircraft.h"
#include "envs/state/state.h"
#include "envs/vec_env.h"
#include "tests/envs/step_buffers.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr int kCount = 32;
constexpr double kInterval = 0.02;

/// An environment whose flights begin level and untrimmed, after one control step.
VecEnv AfterOneStep(const Gravity& gravity) {
  EnvConfig config;
  config.initial.trimmed = false;
  config.initial.altitude_ft = {40000, 40000};
  config.gravity = gravity;
  VecEnv env(config, kCount, 1, kCount);
  StepBuffers step(kCount);
  env.Step(0, step.action.data(), step.output());
  return env;
}

// Whatever else acts is the same in the first step: the velocity along body z differs by gravity's
// difference times the step.
TEST(VecEnvGravity, PullsAsConfigured) {
  constexpr Tolerance kFirstStep{2e-3, "what alpha and pitch gain within the step, ft/s"};
  const VecEnv usual = AfterOneStep({});
  const VecEnv weaker = AfterOneStep({kGravityFtS2 - 10, false});
  const VecEnv falling = AfterOneStep({1000, true});
  const VecEnv strong = AfterOneStep({Gravity{1000, true}.At(40000), false});
  for (int i = 0; i < kCount; ++i) {
    EXPECT_NEAR(usual.StateOf(i, kW) - weaker.StateOf(i, kW), 10 * kInterval, kFirstStep);
    EXPECT_NEAR(falling.StateOf(i, kW), strong.StateOf(i, kW), kFirstStep);
  }
}

// Level flight needs less lift where less pulls.
TEST(VecEnvGravity, TrimmedStartsHoldUpTheWeightThatThereIs) {
  constexpr Tolerance kAttitude{2e-3, "cosines of pitch and bank"};
  EnvConfig config;
  config.gravity.at_sea_level_ft_s2 = kGravityFtS2 / 2;
  const VecEnv env(config, kCount, 1, kCount);
  for (int i = 0; i < kCount; ++i) EXPECT_NEAR(env.StateOf(i, kNz), 0.5, kAttitude);
}

}  // namespace
}  // namespace skein
