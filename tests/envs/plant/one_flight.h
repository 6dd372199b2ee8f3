// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "envs/vec_env.h"
#include "tests/envs/step_buffers.h"

/// One flight of the environment, to be compared with another one.
namespace skein::one_flight {

using Action = std::array<float, 4>;
using Actions = std::function<Action(int step)>;

inline constexpr double kInterval = 0.02;  // s, of a control step

/// One F-16 at 20,000 ft and 900 ft/s in steady flight, without noise.
inline EnvConfig OneFlight() {
  EnvConfig config;
  config.observation_noise = 0;
  config.initial.altitude_ft = {20000, 20000};
  config.initial.true_airspeed_fps = {900, 900};
  return config;
}

/// A pull, a roll and a push of the rudder, after one another and together.
inline Action Lively(int step) {
  const float t = static_cast<float>(step) * 0.02f;
  return {0.2f, 0.3f * std::sin(3 * t), 0.4f * std::sin(2 * t + 1), 0.2f * std::sin(t)};
}

/// Columns of the state after each control step, in their order.
inline std::vector<float> Fly(const EnvConfig& config, const Actions& actions, int steps) {
  VecEnv env(config, 1, 1);
  StepBuffers buffers(1);
  std::vector<float> states;
  for (int step = 0; step < steps; ++step) {
    const Action action = actions(step);
    std::copy(action.begin(), action.end(), buffers.action.begin());
    env.Step(0, buffers.action.data(), buffers.output());
    EXPECT_EQ(buffers.termination[0], 0);
    for (int column = 0; column < kNumColumns; ++column) {
      states.push_back(env.StateOf(0, column));
    }
  }
  return states;
}

/// OneFlight with a plant that is drawn, and nominal: other kernels fly it, which round otherwise.
inline EnvConfig OneDrawnFlight() {
  EnvConfig config = OneFlight();
  config.plant.sensor_freeze_chance = 1e-9;  // never, and yet not off
  return config;
}

}  // namespace skein::one_flight
