// SPDX-License-Identifier: Apache-2.0
// What flights by given actions come to on every SIMD target, to the bit: a change of one of these
// numbers is a change of results, and its message says why. SSE4 and scalar agree, and AVX2 and
// NEON: the architecture has no part in it. The C library has one, where episodes begin.
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/fnv_hash.h"
#include "envs/vec_env.h"
#include "simd/random.h"
#include "simd/target.h"
#include "tests/envs/step_buffers.h"

namespace skein {
namespace {

using simd::Target;

/// Without and with rotational gusts.
struct Flights {
  std::string linear, rotational;
};
const std::map<Target, Flights> kExpected = {
    {Target::kAvx512, {"58d27c1cba392d45", "88c06e16b1524122"}},
    {Target::kAvx2, {"db08d69edcc32df7", "c103a69fa61cff93"}},
    {Target::kSse4, {"28b88b9ae165417e", "4c85b803a70ebb55"}},
    {Target::kNeon, {"db08d69edcc32df7", "c103a69fa61cff93"}},
    {Target::kScalar, {"28b88b9ae165417e", "4c85b803a70ebb55"}}};

/// Aircraft of one tile, and policy steps of each.
constexpr int kAircraft = 40, kSteps = 30;

/// Wind, turbulence, noise and drawn plants; episodes end.
EnvConfig Config(const std::string& task, bool rotational_gusts) {
  EnvConfig config;
  config.task = task;
  config.action_repeat = 5;
  config.stagger_clocks = true;
  config.time_limit_steps = config.heading.earliest_success_step = 100;
  config.wind.speed_fps = {0, 120};
  config.wind.turbulence_fps = {0, 20};
  config.wind.rotational_gusts = rotational_gusts;
  config.observation_noise_max = 0.1;
  config.plant.mass = config.plant.thrust = {0.7, 1.3};
  return config;
}

/// Adds all that the environment says and holds.
void AddFlights(const EnvConfig& config, FnvHash* hash) {
  VecEnv env(config, kAircraft, 1);
  StepBuffers buffers(kAircraft);
  simd::RandomStream random({9, 0, 0, 0, simd::RandomPurpose::kActionNoise});
  for (int step = 0; step < kSteps; ++step) {
    env.Observe(0, buffers.observation.data());
    hash->Add(buffers.observation.data(), buffers.observation.size() * sizeof(float));
    for (float& action : buffers.action) action = static_cast<float>(random.Uniform(-0.5, 0.5));
    env.Step(0, buffers.action.data(), buffers.output());
    hash->Add(buffers.reward.data(), buffers.reward.size() * sizeof(float));
  }
  const std::vector<std::uint32_t> state = env.Snapshot();
  hash->Add(state.data(), state.size() * sizeof state[0]);
}

/// Of every task, on the active target.
std::string BitsOfFlights(bool rotational_gusts) {
  FnvHash hash;
  for (const char* const task : {"control", "heading", "tracking"}) {
    AddFlights(Config(task, rotational_gusts), &hash);
  }
  return hash.Hex();
}

TEST(FlightBits, AreThoseOfTheTarget) {
#if !defined(__GLIBC__) || __GLIBC__ != 2 || __GLIBC_MINOR__ != 36
  GTEST_SKIP() << "the numbers are of glibc 2.36";
#endif
  const Target before = simd::ActiveTarget();
  for (const Target target : simd::SupportedTargets()) {
    simd::ForceTarget(target);
    const Flights& expected = kExpected.at(target);
    EXPECT_EQ(BitsOfFlights(false), expected.linear) << simd::Name(target);
    EXPECT_EQ(BitsOfFlights(true), expected.rotational) << simd::Name(target);
  }
  simd::ForceTarget(before);
}

}  // namespace
}  // namespace skein
