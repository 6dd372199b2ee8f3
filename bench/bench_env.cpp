// SPDX-License-Identifier: Apache-2.0
// The environment's parts around the plant, on one tile that stays in the innermost caches: flight
// control, reward and termination, observation, noise, beginnings of episodes. RK4 is the
// yardstick. Observations and their noise are made once per policy step, the others in every
// control step.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "base/aligned_vector.h"
#include "base/denormals.h"
#include "bench/noise_part.h"
#include "bench/report.h"
#include "envs/aircraft/f16.h"
#include "envs/flight_reset.h"
#include "envs/kernels/flight_control_kernel.h"
#include "envs/kernels/plant_kernel.h"
#include "envs/task_registry.h"
#include "envs/tasks/observation.h"
#include "envs/tasks/reward_and_termination.h"
#include "envs/vec_env.h"
#include "simd/random.h"

namespace skein::bench {
namespace {

constexpr int kTileSize = 128;
// Timed together: many times what reading the clock takes.
constexpr int kRounds = 32;
constexpr float kDt = 0.02f;

/// One tile of trimmed flights, and all that acts on it.
struct TrimmedTile {
  TrimmedTile() {
    const VecEnv env(config, kTileSize, 1);
    for (int i = 0; i < kTileSize; ++i) {
      for (int column = 0; column < kNumColumns; ++column) {
        tile()[column][i] = env.StateOf(i, column);
      }
      const std::vector<float> targets = env.TargetOf(i);
      for (int column = 0; column < task->num_targets(); ++column) {
        task_tile()[column][i] = targets[static_cast<std::size_t>(column)];
      }
    }
  }

  Tile tile() { return {flight.data(), stride, kTileSize}; }
  Tile task_tile() { return {target.data(), stride, kTileSize}; }

  DenormalsFlushed flushed;  // as on the environment's workers
  EnvConfig config;
  std::size_t stride = TileStride(kTileSize);
  std::shared_ptr<const KernelAircraft> aircraft = MakeKernelAircraft(F16(), config.atmosphere);
  std::unique_ptr<Task> task = MakeTask(config);
  // Columns begin at cache lines, as the environment's do.
  AlignedVector<float> flight = AlignedVector<float>(stride * kNumColumns);
  AlignedVector<float> target =
      AlignedVector<float>(stride * static_cast<std::size_t>(task->num_columns()));
  AlignedVector<float> command = AlignedVector<float>(stride, 0.1f);
  AlignedVector<float> errors = AlignedVector<float>(stride * kNumTaskErrors);
  AlignedVector<float> reward = AlignedVector<float>(stride), policy_step = reward, total = reward;
  AlignedVector<std::int32_t> reached = AlignedVector<std::int32_t>(stride), step = reached,
                              termination = reached, episode = reached;
  AlignedVector<float> observation =
      AlignedVector<float>(static_cast<std::size_t>(kTileSize) * kObservationSize);
};

/// Times `part`, one round of the tile's work.
template <class Part>
void TimeRounds(benchmark::State& state, const Part& part) {
  Meter meter(&state, static_cast<double>(kTileSize) * kRounds);
  for (auto _ : state) {
    meter.Time([&] {
      for (int round = 0; round < kRounds; ++round) {
        part();
        benchmark::ClobberMemory();
      }
    });
  }
  meter.Report();
}

void BM_Rk4(benchmark::State& state) {
  TrimmedTile t;
  const AlignedVector<float> start = t.flight;
  Meter meter(&state, static_cast<double>(kTileSize) * kRounds, kFlopsPerRk4Step);
  for (auto _ : state) {
    // Hands-off flight goes on for ever; starting anew keeps it near the trim.
    t.flight = start;
    meter.Time([&] {
      for (int round = 0; round < kRounds; ++round) StepTile(*t.aircraft, t.tile(), kDt, 1);
    });
  }
  meter.Report();
}
BENCHMARK(BM_Rk4)->UseManualTime();

void BM_FlightControl(benchmark::State& state) {
  TrimmedTile t;
  const float* const command = t.command.data();
  const PilotColumns pilot{command, command, command, command};
  const FlightControlConstants constants(F16(), FlightControlMode::kFull, kDt);
  TimeRounds(state, [&] { ControlTile(*t.aircraft, constants, t.tile(), pilot); });
}
BENCHMARK(BM_FlightControl)->UseManualTime();

void BM_RewardAndTermination(benchmark::State& state) {
  TrimmedTile t;
  const StepResult step_result{t.reward.data(), t.reached.data()};
  const TerminationLimits limits(t.config.termination, t.config.episode());
  TimeRounds(state, [&] {
    t.task->ComputeReward(t.tile(), t.task_tile(), t.step.data(), step_result);
    ComputeRewardAndTermination(
        *t.aircraft, limits, t.tile(), step_result,
        {t.step.data(), t.termination.data(), t.policy_step.data(), t.total.data()});
  });
}
BENCHMARK(BM_RewardAndTermination)->UseManualTime();

void BM_Observe(benchmark::State& state) {
  TrimmedTile t;
  const bool noisy = state.range(0) != 0;
  const double noise = noisy ? t.config.observation_noise : 0;
  TimeRounds(state, [&] {
    t.task->Errors(t.tile(), t.task_tile(), t.errors.data(), t.stride);
    ObserveTile(*t.aircraft, t.tile(), {t.errors.data(), t.stride},
                {noise, 1, 0, t.episode.data(), t.step.data()}, t.observation.data());
  });
}
BENCHMARK(BM_Observe)->ArgName("noise")->Arg(0)->Arg(1)->UseManualTime();

/// The deviates alone.
void BM_Noise(benchmark::State& state) {
  TrimmedTile t;
  TimeRounds(state,
             [&] { DrawNoise(1, kTileSize, t.episode.data(), t.step.data(), t.reward.data()); });
}
BENCHMARK(BM_Noise)->UseManualTime();

/// The state and the target of a new episode, drawn in float64 for one aircraft at a time.
void BM_Reset(benchmark::State& state) {
  const EnvConfig config;
  const FlightReset reset(config, F16());
  const std::unique_ptr<Task> task = MakeTask(config);
  std::vector<float> columns(static_cast<std::size_t>(task->num_columns()));
  const Tile targets{columns.data(), 1, 1};
  std::uint32_t episode = 0;
  Meter meter(&state, kTileSize);
  for (auto _ : state) {
    meter.Time([&] {
      for (std::uint32_t i = 0; i < kTileSize; ++i) {
        simd::RandomStream initial({1, i, episode, 0, simd::RandomPurpose::kInitialState});
        FreshFlight flight = reset.Draw(&initial);
        simd::RandomStream target({1, i, episode, 0, simd::RandomPurpose::kTarget});
        task->Reset(flight.start, &target, targets, 0);
        benchmark::DoNotOptimize(flight.columns);
        benchmark::DoNotOptimize(columns.data());
      }
    });
    ++episode;
  }
  meter.Report();
}
BENCHMARK(BM_Reset)->UseManualTime();

}  // namespace
}  // namespace skein::bench
