// SPDX-License-Identifier: Apache-2.0
// The autopilot's control step on one tile that stays in the innermost caches, and as a yardstick
// the environment's on the same flights: observation, flight control, RK4, reward, terminations.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "bench/report.h"
#include "envs/autopilot/autopilot.h"
#include "envs/step_memory.h"
#include "envs/vec_env.h"

namespace skein::bench {
namespace {

constexpr int kTileSize = 128;
// Timed together: many times what reading the clock takes.
constexpr int kRounds = 32;

/// A tile of aircraft that an autopilot flies: its actions of the first kRounds control steps are
/// kept, so that the environment can step without it. Begin goes back to where they began, so that
/// few episodes end.
class FlownTile {
 public:
  explicit FlownTile(const char* task)
      : config_(ConfigOf(task)),
        env_(config_, kTileSize, 1, kTileSize),
        autopilot_(MakeAutopilot(config_, AutopilotVariant::kTraditional)),
        start_(env_.Snapshot()),
        observation_(Times(env_.observation_size())),
        memory_(Times(autopilot_->state_size())),
        actions_(kRounds * Times(env_.action_size())),
        step_memory_(kTileSize) {
    for (int round = 0; round < kRounds; ++round) {
      Observe();
      Act(round);
      Step(round);
    }
  }

  void Begin() { env_.Restore(start_); }
  void Observe() { env_.Observe(0, observation_.data()); }
  /// On what was observed last.
  void Act(int round) {
    autopilot_->Act(kTileSize, observation_.data(), memory_.data(), ActionsOf(round));
  }
  void Step(int round) { env_.Step(0, ActionsOf(round), step_memory_.output()); }

 private:
  static EnvConfig ConfigOf(const char* task) {
    EnvConfig config;
    config.task = task;
    config.observation_noise = 0;
    return config;
  }
  static std::size_t Times(int size) {
    return static_cast<std::size_t>(kTileSize) * static_cast<std::size_t>(size);
  }

  float* ActionsOf(int round) {
    return actions_.data() + static_cast<std::size_t>(round) * Times(env_.action_size());
  }

  EnvConfig config_;
  VecEnv env_;
  std::unique_ptr<Policy> autopilot_;
  std::vector<std::uint32_t> start_;
  std::vector<float> observation_, memory_, actions_;
  StepMemory step_memory_;
};

const char* const kTasks[] = {"heading", "control", "tracking"};

void BM_Autopilot(benchmark::State& state) {
  const char* const task = kTasks[state.range(0)];
  FlownTile tile(task);
  Meter meter(&state, static_cast<double>(kTileSize) * kRounds);
  for (auto _ : state) {
    meter.Time([&] {
      for (int round = 0; round < kRounds; ++round) {
        tile.Act(round);
        benchmark::ClobberMemory();
      }
    });
  }
  state.SetLabel(task);
  meter.Report();
}
BENCHMARK(BM_Autopilot)->ArgName("task")->DenseRange(0, 2)->UseManualTime();

void BM_Environment(benchmark::State& state) {
  const char* const task = kTasks[state.range(0)];
  FlownTile tile(task);
  Meter meter(&state, static_cast<double>(kTileSize) * kRounds);
  for (auto _ : state) {
    tile.Begin();
    meter.Time([&] {
      for (int round = 0; round < kRounds; ++round) {
        tile.Observe();
        tile.Step(round);
      }
    });
  }
  state.SetLabel(task);
  meter.Report();
}
BENCHMARK(BM_Environment)->ArgName("task")->DenseRange(0, 2)->UseManualTime();

}  // namespace
}  // namespace skein::bench
