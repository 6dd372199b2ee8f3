// SPDX-License-Identifier: Apache-2.0
// Whole control steps of the Heading environment under random actions (observation, flight control,
// actuators, engine, RK4, reward, terminations, resets), at 10^2 to 10^7 aircraft.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/worker_pool.h"
#include "bench/report.h"
#include "envs/vec_env.h"
#include "simd/random.h"

namespace skein::bench {
namespace {

constexpr int kTileSize = 128;  // stays in the innermost caches

/// The environment of `aircraft`: made once for all numbers of threads, since the largest takes
/// seconds. One at a time, for its memory.
VecEnv& Environment(int aircraft, bool noisy) {
  static std::unique_ptr<VecEnv> env;
  EnvConfig config;
  if (!noisy) config.observation_noise = 0;
  const bool fits = env != nullptr && env->num_aircraft() == aircraft &&
                    env->config().observation_noise == config.observation_noise;
  if (!fits) {
    env.reset();
    env = std::make_unique<VecEnv>(config, aircraft, 1, kTileSize);
  }
  return *env;
}

/// What one worker hands to and takes from the environment, tile after tile.
struct Buffers {
  explicit Buffers(const VecEnv& env)
      : observation(static_cast<std::size_t>(kTileSize) *
                    static_cast<std::size_t>(env.observation_size())),
        action(static_cast<std::size_t>(kTileSize) * static_cast<std::size_t>(env.action_size())),
        reward(kTileSize),
        episode_return(kTileSize),
        termination(kTileSize),
        episode_steps(kTileSize) {
    simd::RandomStream random({1, 0, 0, 0, simd::RandomPurpose::kActionNoise});
    for (float& value : action) value = static_cast<float>(random.Uniform(-1, 1));
  }

  std::vector<float> observation, action, reward, episode_return;
  std::vector<std::uint8_t> termination;
  std::vector<std::int32_t> episode_steps;
};

void Step(benchmark::State& state, bool noisy) {
  VecEnv& env = Environment(static_cast<int>(state.range(0)), noisy);
  WorkerPool pool(static_cast<int>(state.range(1)));
  std::vector<Buffers> workers(static_cast<std::size_t>(pool.threads()), Buffers(env));
  const auto step = [&] {
    pool.ForEach(env.num_tiles(), [&](int tile, int worker) {
      Buffers& buffers = workers[static_cast<std::size_t>(worker)];
      env.Observe(tile, buffers.observation.data());
      env.Step(tile, buffers.action.data(),
               {buffers.reward.data(), buffers.termination.data(), buffers.episode_return.data(),
                buffers.episode_steps.data(), nullptr});
    });
  };
  step();  // pages and caches are warm from here on
  Meter meter(&state, env.num_aircraft(), 0, pool.threads());
  for (auto _ : state) meter.Time(step);
  meter.Report();
}

void BM_Step(benchmark::State& state) { Step(state, false); }
void BM_NoisyStep(benchmark::State& state) { Step(state, true); }

/// Adds `aircraft` with 1, 2, 4, ... threads, and with as many as there are CPUs.
void AddThreads(benchmark::internal::Benchmark* benchmark, std::int64_t aircraft) {
  const int most = WorkerPool().threads();
  for (int threads = 1; threads < most; threads *= 2) benchmark->Args({aircraft, threads});
  benchmark->Args({aircraft, most});
}

void UpToAMillion(benchmark::internal::Benchmark* benchmark) {
  for (std::int64_t aircraft = 100; aircraft <= 1000000; aircraft *= 10) {
    AddThreads(benchmark, aircraft);
  }
}

void TenMillion(benchmark::internal::Benchmark* benchmark) { AddThreads(benchmark, 10000000); }

void Describe(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"aircraft", "threads"})->Unit(::benchmark::kMicrosecond)->UseManualTime();
}

BENCHMARK(BM_Step)->Apply(UpToAMillion)->Apply(Describe);
BENCHMARK(BM_NoisyStep)->Apply(UpToAMillion)->Apply(Describe);
// About 2 GB and some seconds to begin with: few iterations.
BENCHMARK(BM_Step)->Apply(TenMillion)->Apply(Describe)->Iterations(3);

}  // namespace
}  // namespace skein::bench
