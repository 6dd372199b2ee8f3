// SPDX-License-Identifier: Apache-2.0
#include "envs/step_memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "envs/flight_metrics.h"
#include "envs/vec_env.h"

namespace skein {
namespace {

TEST(StepMemoryTest, OutputsOfTilesLieBehindOneAnother) {
  constexpr int kCount = 70, kFirst = 32;
  StepMemory memory(kCount, {5, 3, 2});
  EXPECT_EQ(memory.reward.size(), 70u);
  EXPECT_EQ(memory.final_observation.size(), 350u);
  EXPECT_EQ(memory.final_privileged.size(), 210u);
  EXPECT_EQ(memory.flight_metrics.size(), 140u);
  const StepOutput output = memory.output(kFirst);
  EXPECT_EQ(output.reward, memory.reward.data() + kFirst);
  EXPECT_EQ(output.termination, memory.termination.data() + kFirst);
  EXPECT_EQ(output.episode_return, memory.episode_return.data() + kFirst);
  EXPECT_EQ(output.episode_steps, memory.episode_steps.data() + kFirst);
  EXPECT_EQ(output.first_clock, memory.first_clock.data() + kFirst);
  EXPECT_EQ(output.final_observation, memory.final_observation.data() + 5 * kFirst);
  EXPECT_EQ(output.final_privileged, memory.final_privileged.data() + 3 * kFirst);
  EXPECT_EQ(output.flight_metrics, memory.flight_metrics.data() + 2 * kFirst);
}

TEST(StepMemoryTest, WhatIsNotKeptIsNull) {
  const StepOutput output = StepMemory(4).output(1);
  EXPECT_EQ(output.final_observation, nullptr);
  EXPECT_EQ(output.final_privileged, nullptr);
  EXPECT_EQ(output.flight_metrics, nullptr);
  EXPECT_EQ(output.observer, nullptr);
  EXPECT_FALSE(output.observes_every_end);
}

/// Rewards and observations of 40 policy steps, and the memory of the last.
struct Flight {
  Flight(const EnvConfig& config, const StepRows& rows)
      : env(config, kCount, 1, kTileSize), memory(kCount, rows) {
    const auto size = static_cast<std::size_t>(env.observation_size());
    std::vector<float> action(kCount * static_cast<std::size_t>(env.action_size()));
    std::vector<float> observation(kCount * size);
    for (int step = 0; step < 40; ++step) {
      for (std::size_t k = 0; k < action.size(); ++k) {
        action[k] = 0.3f * std::sin(static_cast<float>(k + static_cast<std::size_t>(3 * step)));
      }
      for (int tile = 0; tile < env.num_tiles(); ++tile) {
        const auto first = static_cast<std::size_t>(env.tile_begin(tile));
        env.Step(tile, action.data() + first * static_cast<std::size_t>(env.action_size()),
                 memory.output(env.tile_begin(tile)));
        env.Observe(tile, observation.data() + first * size);
      }
      seen.insert(seen.end(), memory.reward.begin(), memory.reward.end());
      seen.insert(seen.end(), observation.begin(), observation.end());
    }
  }

  static constexpr int kCount = 70, kTileSize = 32;
  VecEnv env;
  StepMemory memory;
  std::vector<float> seen;
};

TEST(StepMemoryTest, WhatIsKeptChangesNoFlight) {
  EnvConfig config;
  config.action_repeat = 25;
  config.time_limit_steps = config.heading.earliest_success_step = 60;
  config.truncate_at_time_limit = true;
  // Episodes end within policy steps, and are observed late.
  config.plant.observation_delay_steps = {0, kLongestDelay};
  const VecEnv sizes(config, 1, 1);
  const Flight plain(config, {});
  const Flight full(config, {sizes.observation_size(), sizes.privileged_size(), kNumFlightMetrics});
  EXPECT_EQ(plain.seen, full.seen);
  EXPECT_EQ(plain.memory.termination, full.memory.termination);
  EXPECT_EQ(plain.memory.episode_return, full.memory.episode_return);
  EXPECT_EQ(plain.memory.episode_steps, full.memory.episode_steps);
  for (int i = 0; i < Flight::kCount; ++i) {
    const auto row = static_cast<std::size_t>(i);
    EXPECT_GT(full.memory.episode_steps[row], 0) << i;
    EXPECT_GT(full.memory.flight_metrics[row * kNumFlightMetrics + kMeanMach], 0) << i;
  }
}

}  // namespace
}  // namespace skein
