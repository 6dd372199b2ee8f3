// Rates of the environment's parts and of whole control steps, in aircraft-steps per second. BM_Rk4
// is the yardstick of the other parts. Observations and their noise are made once per decision, the
// others in every control step.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "envs/aircraft/f16/f16.h"
#include "envs/aircraft/flight_control_kernel.h"
#include "envs/dynamics/plant_kernel.h"
#include "envs/tasks/judgement.h"
#include "envs/tasks/observation.h"
#include "envs/tasks/task.h"
#include "envs/vec_env.h"
#include "envs/worker_pool.h"
#include "simd/denormals.h"
#include "simd/random.h"

namespace skein {
namespace {

constexpr int kTileSize = 128;

void ReportRate(benchmark::State& state, std::int64_t aircraft) {
  state.counters["aircraft_steps"] = benchmark::Counter(  // printed per second
      static_cast<double>(state.iterations() * aircraft), benchmark::Counter::kIsRate);
}

/// One tile of trimmed flights that stays in the innermost caches, and all that acts on it.
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

  simd::DenormalsFlushed flushed;  // as on the environment's workers
  EnvConfig config;
  std::size_t stride = TileStride(kTileSize);
  std::shared_ptr<const KernelAircraft> aircraft = MakeKernelAircraft(F16(), config.atmosphere);
  std::unique_ptr<Task> task = MakeTask(config);
  std::vector<float> flight = std::vector<float>(stride * kNumColumns);
  std::vector<float> target =
      std::vector<float>(stride * static_cast<std::size_t>(task->num_columns()));
  std::vector<float> pilot = std::vector<float>(stride, 0.1f);
  std::vector<float> errors = std::vector<float>(stride * kNumTaskErrors);
  std::vector<float> reward = std::vector<float>(stride), decision = reward, total = reward;
  std::vector<std::int32_t> reached = std::vector<std::int32_t>(stride), step = reached,
                            termination = reached, episode = reached;
  std::vector<float> observation =
      std::vector<float>(static_cast<std::size_t>(kTileSize) * kObservationSize);
};

void BM_Rk4(benchmark::State& state) {
  TrimmedTile t;
  const std::vector<float> start = t.flight;
  for (auto _ : state) {
    StepTile(*t.aircraft, t.tile(), 0.02f, 1);
    // Hands-off flight goes on for ever; starting anew keeps it near the trim.
    t.flight = start;
  }
  ReportRate(state, kTileSize);
}
BENCHMARK(BM_Rk4);

void BM_FlightControl(benchmark::State& state) {
  TrimmedTile t;
  const PilotColumns pilot{t.pilot.data(), t.pilot.data(), t.pilot.data(), t.pilot.data()};
  const FlightControlConstants constants(F16(), FlightControlMode::kFull, 0.02);
  for (auto _ : state) {
    ControlTile(*t.aircraft, constants, t.tile(), pilot);
  }
  ReportRate(state, kTileSize);
}
BENCHMARK(BM_FlightControl);

void BM_Judge(benchmark::State& state) {
  TrimmedTile t;
  const TaskVerdict verdict{t.reward.data(), t.reached.data()};
  for (auto _ : state) {
    t.task->Judge(t.tile(), t.task_tile(), t.step.data(), verdict);
    JudgeTile(*t.aircraft, t.config, t.tile(), verdict,
              {t.step.data(), t.termination.data(), t.decision.data(), t.total.data()});
  }
  ReportRate(state, kTileSize);
}
BENCHMARK(BM_Judge);

void BM_Observe(benchmark::State& state) {
  TrimmedTile t;
  const double noise = state.range(0) == 0 ? 0 : 0.01;
  for (auto _ : state) {
    t.task->Errors(t.tile(), t.task_tile(), t.errors.data(), t.stride);
    ObserveTile(*t.aircraft, t.tile(), t.errors.data(), t.stride,
                {noise, 1, 0, t.episode.data(), t.step.data()}, t.observation.data());
    benchmark::ClobberMemory();
  }
  ReportRate(state, kTileSize);
}
BENCHMARK(BM_Observe)->ArgName("noise")->Arg(0)->Arg(1);

/// Whole control steps of an environment: flight control, actuators, engine, RK4, reward,
/// terminations, resets.
void BM_Step(benchmark::State& state) {
  const int count = static_cast<int>(state.range(0));
  VecEnv env(EnvConfig{}, count, 1);
  WorkerPool pool(static_cast<int>(state.range(1)));
  const auto size = static_cast<std::size_t>(count);
  std::vector<float> action(size * 4), reward(size), episode_return(size);
  std::vector<std::uint8_t> termination(size);
  std::vector<std::int32_t> episode_steps(size);
  simd::RandomStream random({1, 0, 0, 0, simd::RandomPurpose::kActionNoise});
  for (float& value : action) value = static_cast<float>(random.Uniform(-0.3, 0.3));
  for (auto _ : state) {
    pool.ForEach(env.num_tiles(), [&](int tile, int) {
      const int begin = env.tile_begin(tile);
      env.Step(tile, action.data() + static_cast<std::size_t>(begin) * 4,
               {reward.data() + begin, termination.data() + begin, episode_return.data() + begin,
                episode_steps.data() + begin, nullptr});
    });
  }
  ReportRate(state, count);
}
BENCHMARK(BM_Step)
    ->ArgNames({"aircraft", "threads"})
    ->Args({4096, 1})
    ->Args({65536, 1})
    ->Args({65536, 2})
    ->Args({1000000, 2})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace skein
