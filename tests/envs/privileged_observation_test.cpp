// SPDX-License-Identifier: Apache-2.0
#include "envs/privileged_observation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "envs/vec_env.h"
#include "tests/envs/step_buffers.h"
#include "tests/extremes.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

constexpr int kCount = 200;  // more than a block
constexpr int kErrors = 3;
constexpr Tolerance kEnd{0.05, "five or more of 200 draws are expected this near to an end"};

std::vector<float> PrivilegedRows(const VecEnv& env) {
  std::vector<float> rows(static_cast<std::size_t>(env.num_aircraft() * env.privileged_size()));
  for (int tile = 0; tile < env.num_tiles(); ++tile) {
    env.ObservePrivileged(tile, rows.data() + env.tile_begin(tile) * env.privileged_size());
  }
  return rows;
}

std::vector<float> Observations(const VecEnv& env) {
  std::vector<float> rows(static_cast<std::size_t>(env.num_aircraft() * env.observation_size()));
  for (int tile = 0; tile < env.num_tiles(); ++tile) {
    env.Observe(tile, rows.data() + env.tile_begin(tile) * env.observation_size());
  }
  return rows;
}

/// Where a number stands in a row.
int IndexOf(const VecEnv& env, const std::string& name) {
  const std::vector<std::string> names = env.privileged_names();
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

TEST(PrivilegedObservation, ErrorsAreThoseOfTheObservationWithoutItsNoise) {
  EnvConfig config;
  config.observation_noise = 0.1;
  const VecEnv noisy(config, kCount, 1);
  config.observation_noise = 0;
  const VecEnv calm(config, kCount, 1);
  const std::vector<float> privileged = PrivilegedRows(noisy), observed = Observations(calm);
  for (int i = 0; i < kCount; ++i) {
    for (int k = 0; k < kErrors; ++k) {
      EXPECT_EQ(privileged[static_cast<std::size_t>(i * noisy.privileged_size() + k)],
                observed[static_cast<std::size_t>(i * calm.observation_size() + k)]);
    }
  }
}

TEST(PrivilegedObservation, HoldsWhatItsNamesSayAndNoMore) {
  EnvConfig config;
  EXPECT_EQ(VecEnv(config, 1, 1).privileged_size(), 5);
  config.wind.speed_fps = {100, 100};
  config.heading.dwell_s = 1;
  config.hold_s = 10;
  const VecEnv env(config, 1, 1);
  const std::vector<std::string> names = env.privileged_names();
  EXPECT_EQ(names.size(), 10u);
  EXPECT_EQ(names.size(), static_cast<std::size_t>(env.privileged_size()));
  for (const char* name : {"clock", "tolerance", "dwell", "reached", "wind_z"}) {
    EXPECT_LT(IndexOf(env, name), env.privileged_size()) << name;
  }
}

TEST(PrivilegedObservation, ShowsClockToleranceAndProgress) {
  EnvConfig config;
  config.time_limit_steps = 100;
  config.heading.altitude_change_ft = 10;  // next to the start: within tolerances at once
  config.heading.yaw_change_rad = 0.01;
  config.heading.speed_change_fps = 2;
  config.heading.earliest_success_step = 1;
  config.heading.dwell_s = 0.4;
  config.heading.training_tolerance_min = 0.5;
  VecEnv env(config, kCount, 1);
  StepBuffers buffers(env.tile_count(0));
  for (int step = 0; step < 10; ++step) env.Step(0, buffers.action.data(), buffers.output());
  const std::vector<float> rows = PrivilegedRows(env);
  constexpr Tolerance kTolerance{1e-6, "of float32"};
  float least = 1, most = 0;
  for (int i = 0; i < kCount; ++i) {
    const float* const row = rows.data() + i * env.privileged_size();
    EXPECT_NEAR(row[IndexOf(env, "clock")], 0.1, kTolerance);
    EXPECT_NEAR(row[IndexOf(env, "dwell")], 0.5, kTolerance);
    least = Smaller(least, row[IndexOf(env, "tolerance")]);
    most = Larger(most, row[IndexOf(env, "tolerance")]);
  }
  EXPECT_NEAR(least, 0.5, kEnd);
  EXPECT_NEAR(most, 1, kEnd);
}

TEST(PrivilegedObservation, ATargetThatIsHeldIsReachedAndItsDwellWhole) {
  EnvConfig config;
  config.heading.altitude_change_ft = 10;
  config.heading.yaw_change_rad = 0.01;
  config.heading.speed_change_fps = 2;
  config.heading.earliest_success_step = 1;
  config.heading.dwell_s = 0.1;
  config.hold_s = 2;
  VecEnv env(config, 1, 1);
  StepBuffers buffers(1);
  for (int step = 1; step <= 20; ++step) {
    env.Step(0, buffers.action.data(), buffers.output());
    const std::vector<float> row = PrivilegedRows(env);
    const auto shown = [&](const char* name) {
      return row[static_cast<std::size_t>(IndexOf(env, name))];
    };
    EXPECT_FLOAT_EQ(shown("dwell"), step < 5 ? static_cast<float>(step) / 5 : 1.0f) << step;
    EXPECT_EQ(shown("reached"), step < 5 ? 0 : 1) << step;
  }
}

TEST(PrivilegedObservation, ShowsTheWindAlongTheBodyAxes) {
  EnvConfig config;
  config.wind.speed_fps = {50, 50};
  config.wind.from_deg = {90, 90};  // from the right of an aircraft that heads north
  const VecEnv env(config, kCount, 1);
  const std::vector<float> rows = PrivilegedRows(env);
  constexpr Tolerance kTolerance{0.02, "trimmed flight banks a little, and pitches"};
  for (int i = 0; i < kCount; ++i) {
    const float* const row = rows.data() + i * env.privileged_size();
    EXPECT_NEAR(row[IndexOf(env, "wind_x")], 0, kTolerance);
    EXPECT_NEAR(row[IndexOf(env, "wind_y")], -0.5, kTolerance);
  }
}

TEST(PrivilegedObservation, ShowsHowThePlantDiffers) {
  EnvConfig config;
  config.plant.mass = {1.25, 1.25};
  config.plant.cg_shift = {-0.05, 0.05};
  config.plant.action_delay_steps = {3, 3};
  const VecEnv env(config, kCount, 1);
  const std::vector<float> rows = PrivilegedRows(env);
  constexpr Tolerance kTolerance{1e-5, "of float32"};
  float least = 1, most = -1;
  for (int i = 0; i < kCount; ++i) {
    const float* const row = rows.data() + i * env.privileged_size();
    EXPECT_NEAR(row[IndexOf(env, "plant_inverse_mass")], -1, kTolerance);
    EXPECT_NEAR(row[IndexOf(env, "plant_action_delay")], 1, kTolerance);
    EXPECT_EQ(row[IndexOf(env, "plant_thrust")], 0);
    least = Smaller(least, row[IndexOf(env, "plant_cg_shift")]);
    most = Larger(most, row[IndexOf(env, "plant_cg_shift")]);
  }
  EXPECT_NEAR(least, -1, kEnd);
  EXPECT_NEAR(most, 1, kEnd);
}

}  // namespace
}  // namespace skein
