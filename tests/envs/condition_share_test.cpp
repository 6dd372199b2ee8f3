// SPDX-License-Identifier: Apache-2.0
// VecEnv::SetConditionShare: what episodes draw while conditions widen.
#include <gtest/gtest.h>

#include <vector>

#include "envs/vec_env.h"
#include "tests/envs/step_buffers.h"

namespace skein {
namespace {

constexpr int kAircraft = 8;

/// All observations and rewards of ten control steps with the sticks left alone.
std::vector<float> Seen(const EnvConfig& config, double share) {
  VecEnv env(config, kAircraft, 3);
  env.SetConditionShare(share);
  env.Restart();
  StepBuffers buffers(kAircraft);
  std::vector<float> seen;
  for (int step = 0; step < 10; ++step) {
    env.Observe(0, buffers.observation.data());
    seen.insert(seen.end(), buffers.observation.begin(), buffers.observation.end());
    env.Step(0, buffers.action.data(), buffers.output());
    seen.insert(seen.end(), buffers.reward.begin(), buffers.reward.end());
  }
  return seen;
}

TEST(ConditionShare, IsThatOfNarrowerRanges) {
  EnvConfig config;
  config.initial.trimmed = false;  // trims are interpolated between the range's ends
  config.initial.altitude_ft = {19000, 40000};
  config.initial.true_airspeed_fps = {1000, 1800};
  config.wind.speed_fps = {0, 200};
  config.wind.turbulence_fps = {0, 16};
  config.observation_noise = 0.03125;
  config.observation_noise_max = 0.09375;
  config.plant.mass = {0.75, 1.5};
  config.plant.sensor_bias = 0.25;
  config.plant.action_delay_steps = {0, 2};
  EnvConfig half = config;
  half.initial.altitude_ft.max = 29500;
  half.initial.true_airspeed_fps.max = 1400;
  half.wind.speed_fps.max = 100;
  half.wind.turbulence_fps.max = 8;
  half.observation_noise_max = 0.0625;
  half.plant.mass = {0.875, 1.25};
  half.plant.sensor_bias = 0.125;
  half.plant.action_delay_steps = {0, 1};
  EXPECT_EQ(Seen(config, 0.5), Seen(half, 1));
  EXPECT_NE(Seen(config, 1), Seen(half, 1));
}

TEST(ConditionShare, WindsAndLimitsOfTrainingAreThoseThatAreAskedFor) {
  EnvConfig plain;
  plain.initial.trimmed = false;  // it slows down from Mach 0.9605
  plain.initial.altitude_ft = {19000, 19000};
  plain.initial.true_airspeed_fps = {1000, 1000};
  EnvConfig asked = plain;
  asked.wind.speed_fps = {0, 120};
  asked.wind.turbulence_fps = {0, 10};
  asked.termination.min_mach = 0.96;
  asked.termination.min_altitude_ft = 18999.9;
  EnvConfig trained = plain;
  trained.wind.training_speed_max_fps = 120;
  trained.wind.training_turbulence_max_fps = 10;
  trained.termination.training_min_mach = 0.96;
  trained.termination.training_min_altitude_ft = 18999.9;
  for (const bool by_mach : {false, true}) {
    EnvConfig freer = asked;
    if (by_mach)
      freer.termination.min_mach = plain.termination.min_mach;
    else
      freer.termination.min_altitude_ft = plain.termination.min_altitude_ft;
    EXPECT_NE(Seen(asked, 1), Seen(freer, 1)) << by_mach;
  }
  for (const double share : {0.25, 1.0}) {
    EXPECT_EQ(Seen(trained, share), Seen(asked, share));
  }
  EXPECT_EQ(Seen(EvaluationConfig(trained), 1), Seen(plain, 1));
}

}  // namespace
}  // namespace skein
