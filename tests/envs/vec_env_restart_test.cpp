// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "envs/vec_env.h"
#include "tests/envs/step_buffers.h"

namespace skein {
namespace {

using Row = std::vector<float>;

Row RowOf(const std::vector<float>& observation, int aircraft) {
  const auto begin = observation.begin() + static_cast<std::ptrdiff_t>(aircraft) * kObservationSize;
  return {begin, begin + kObservationSize};
}

TEST(VecEnvRestart, BeginsTheEpisodeThatWouldFollowAndLeavesTheOthersAlone) {
  constexpr int kCount = 150, kRestarted = 71;
  const EnvConfig config;
  VecEnv restarted(config, kCount, 1), ended(config, kCount, 1);
  StepBuffers before(kCount), after(kCount), reference(kCount);
  restarted.Observe(0, before.observation.data());
  const auto begins = std::make_unique<bool[]>(kCount);
  begins[kRestarted] = true;
  restarted.Restart(0, begins.get());
  restarted.Observe(0, after.observation.data());
  // An action that is not finite ends an episode at once.
  reference.action[kRestarted * kActionSize] = std::numeric_limits<float>::quiet_NaN();
  ended.Step(0, reference.action.data(), reference.output());
  ended.Observe(0, reference.observation.data());
  for (int i = 0; i < kCount; ++i) {
    EXPECT_EQ(RowOf(after.observation, i),
              RowOf(i == kRestarted ? reference.observation : before.observation, i))
        << i;
  }
}

TEST(VecEnvRestart, EveryEndIsObservedIfThatIsAskedFor) {
  EnvConfig config;
  config.time_limit_steps = config.heading.earliest_success_step = 10;
  config.action_repeat = 10;
  constexpr int kCount = 150;
  VecEnv env(config, kCount, 1);
  // The same flight with a later limit shows the same observation there.
  EnvConfig longer = config;
  longer.time_limit_steps = 1000;
  VecEnv reference(longer, kCount, 1);
  StepBuffers buffers(kCount), reference_buffers(kCount);
  StepOutput output = buffers.output();
  output.observes_every_end = true;
  env.Step(0, buffers.action.data(), output);
  reference.Step(0, reference_buffers.action.data(), reference_buffers.output());
  reference.Observe(0, reference_buffers.observation.data());
  EXPECT_EQ(buffers.final_observation, reference_buffers.observation);
  EXPECT_EQ(buffers.termination,
            std::vector<std::uint8_t>(kCount, static_cast<std::uint8_t>(Termination::kTimeLimit)));
}

}  // namespace
}  // namespace skein
