// SPDX-License-Identifier: Apache-2.0
// The built-in tasks as task files: the same bits.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "envs/vec_env.h"
#include "simd/random.h"
#include "simd/target.h"
#include "src/config/configuration.h"
#include "tests/envs/step_buffers.h"
#include "tests/scoped_target.h"
#include "tests/tolerance.h"

namespace skein {
namespace {

/// A built-in task, and the task file that should be the same.
struct Pair {
  const char* name;
  std::vector<std::string> settings = {};  ///< of both
  std::vector<std::string> built_in = {};  ///< what makes the built-in task's preset the file's
};

std::ostream& operator<<(std::ostream& out, const Pair& pair) { return out << pair.name; }

constexpr Tolerance kGivenAttitude{1e-4, "float32 rounding of an attitude, there and back"};

class TaskFileEqualityTest : public testing::TestWithParam<std::tuple<simd::Target, Pair>> {};

template <typename T>
bool SameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

EnvConfig ConfigOf(const std::string& task, const std::vector<std::string>& settings) {
  EnvConfig env = ResolveConfig({task, "default", "", settings}).train.env;
  env.time_limit_steps = 700;  // so that many episodes begin and end
  env.action_repeat = 2;
  return env;
}

/// What no policy observes: the share of the tolerances, too.
std::vector<float> Privileged(const VecEnv& env) {
  std::vector<float> rows(static_cast<std::size_t>(env.num_aircraft() * env.privileged_size()));
  env.ObservePrivileged(0, rows.data());
  return rows;
}

TEST_P(TaskFileEqualityTest, FliesAsTheBuiltInTask) {
  const ScopedTarget target(std::get<0>(GetParam()));
  const Pair& pair = std::get<1>(GetParam());
  constexpr int kAircraft = 150, kSteps = 1200;
  const std::string file = std::string(SKEIN_SOURCE "/examples/tasks/") + pair.name + ".toml";
  VecEnv ours(ConfigOf(file, pair.settings), kAircraft, 11, kAircraft);
  std::vector<std::string> settings = pair.settings;
  settings.insert(settings.end(), pair.built_in.begin(), pair.built_in.end());
  VecEnv built_in(ConfigOf(pair.name, settings), kAircraft, 11, kAircraft);
  ASSERT_EQ(ours.observation_size(), built_in.observation_size());
  const int count = ours.tile_count(0);
  StepBuffers a(count), b(count);
  simd::RandomStream random({5, 0, 0, 0, simd::RandomPurpose::kActionNoise});
  int ended = 0;
  for (int step = 0; step < kSteps; ++step) {
    // Gentle sticks about the trim for most, so that targets come near, too.
    const double most = step % 400 < 300 ? 0.15 : 1;
    for (float& action : a.action) action = static_cast<float>(random.Uniform(-most, most));
    b.action = a.action;
    ours.Observe(0, a.observation.data());
    built_in.Observe(0, b.observation.data());
    ASSERT_TRUE(SameBits(a.observation, b.observation)) << "observations of step " << step;
    ASSERT_TRUE(SameBits(Privileged(ours), Privileged(built_in))) << "step " << step;
    ours.Step(0, a.action.data(), a.output());
    built_in.Step(0, b.action.data(), b.output());
    ASSERT_TRUE(SameBits(a.reward, b.reward)) << "rewards of step " << step;
    ASSERT_EQ(a.termination, b.termination) << "step " << step;
    ASSERT_EQ(a.episode_return, b.episode_return) << "step " << step;
    ended += static_cast<int>(count - std::count(a.termination.begin(), a.termination.end(), 0));
  }
  EXPECT_GT(ended, kAircraft);
  for (int i = 0; i < count; ++i) ASSERT_EQ(ours.TargetOf(i), built_in.TargetOf(i));
  // Targets that are given, each aircraft its neighbour's.
  const std::vector<float> first = ours.TargetOf(0);
  for (int i = 0; i < count; ++i) {
    const std::vector<float> given = i + 1 < count ? ours.TargetOf(i + 1) : first;
    ours.SetTarget(i, given);
    built_in.SetTarget(i, given);
  }
  ours.Step(0, a.action.data(), a.output());
  built_in.Step(0, a.action.data(), b.output());
  for (std::size_t i = 0; i < a.reward.size(); ++i) {
    EXPECT_NEAR(a.reward[i], b.reward[i], kGivenAttitude) << "target that is given to " << i;
  }
  const EnvConfig evaluated = EvaluationConfig(ConfigOf(file, pair.settings));
  const EnvConfig evaluated_built_in = EvaluationConfig(ConfigOf(pair.name, settings));
  EXPECT_EQ(Privileged(VecEnv(evaluated, kAircraft, 11, kAircraft)),
            Privileged(VecEnv(evaluated_built_in, kAircraft, 11, kAircraft)));
}

const std::vector<std::string> kConditions = {
    "env.wind.speed_min_fps=10",         "env.wind.speed_max_fps=60",
    "env.wind.turbulence_max_fps=5",     "env.observation_noise=0.03",
    "env.initial.altitude_min_ft=10000", "env.target_mach_min=0.8"};

/// Tracking's preset flies on from point to point, and rewards the approach.
const std::vector<std::string> kSinglePoints = {
    "env.tracking.distance_weight=1",         "env.tracking.approach_weight=0",
    "env.tracking.training_tolerance_max=5",  "env.mission.training_length_s=0",
    "env.mission.training_time_limit_s=0",    "ppo.time_limit_ramp=0",
    "env.truncate_at_time_limit=false",       "env.training_noise_max=0",
    "env.initial.training_altitude_min_ft=0", "env.wind.training_speed_max_fps=0",
    "env.wind.training_turbulence_max_fps=0", "env.termination.training_min_mach=0",
    "env.termination.failure_reward=-200",    "env.termination.success_reward=200"};

/// Target after target, from low flights: none may lead into the ground.
const std::vector<std::string> kMissions = {
    "env.hold_s=0", "env.mission.length_s=40", "env.mission.dwell_s=1",
    "env.initial.altitude_min_ft=3500", "env.initial.altitude_max_ft=4500"};

std::vector<Pair> Pairs() {
  return {{"heading"},
          {"control"},
          {"tracking", {}, kSinglePoints},
          {"heading", kConditions},
          {"tracking", kConditions, kSinglePoints},
          {"heading", kMissions},
          {"control", kMissions},
          {"tracking", kMissions, kSinglePoints}};
}

INSTANTIATE_TEST_SUITE_P(Targets, TaskFileEqualityTest,
                         testing::Combine(testing::ValuesIn(simd::SupportedTargets()),
                                          testing::ValuesIn(Pairs())));

}  // namespace
}  // namespace skein
