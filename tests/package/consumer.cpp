// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <cstdio>
#include <vector>

#include "envs/state/state.h"
#include "envs/vec_env.h"

int main() {
  skein::EnvConfig config;
  skein::VecEnv env(config, 32, 1);
  const std::vector<float> action(32 * 4, 0.0f);
  std::vector<float> reward(32), episode_return(32);
  std::vector<std::uint8_t> termination(32);
  std::vector<std::int32_t> episode_steps(32);
  skein::StepOutput output;
  output.reward = reward.data();
  output.termination = termination.data();
  output.episode_return = episode_return.data();
  output.episode_steps = episode_steps.data();
  for (int step = 0; step < 50; ++step) env.Step(0, action.data(), output);
  const float altitude_ft = -env.StateOf(0, skein::kDown);
  std::printf("altitude after one second: %.0f ft\n", altitude_ft);
  return altitude_ft > 10000 && altitude_ft < 30000 ? 0 : 1;
}
