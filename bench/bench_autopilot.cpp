// SPDX-License-Identifier: Apache-2.0
// The autopilot's control step on one tile that stays in the innermost caches, and as a yardstick
// the environment's that it flies: observation, flight control, RK4, reward, terminations.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "bench/report.h"
#include "envs/autopilot/autopilot.h"
#include "envs/vec_env.h"

namespace skein::bench {
namespace {

constexpr int kTileSize = 128;
// Timed together: many times what reading the clock takes.
constexpr int kRounds = 32;

/// A tile of aircraft that an autopilot flies; it is at its beginning again before every call that
/// is timed, so that few episodes end.
class FlownTile {
 public:
  explicit FlownTile(const char* task)
      : config_(ConfigOf(task)),
        env_(config_, kTileSize, 1, kTileSize),
        autopilot_(MakeAutopilot(config_, AutopilotVariant::kTraditional)),
        start_(env_.Snapshot()),
        observation_(Times(env_.observation_size())),
        memory_(Times(autopilot_->state_size())),
        action_(Times(env_.action_size())),
        reward_(Times(1)),
        episode_return_(Times(1)),
        termination_(Times(1)),
        episode_steps_(Times(1)) {
    Observe();
  }

  void Begin() { env_.Restore(start_); }
  void Observe() { env_.Observe(0, observation_.data()); }
  void Act() { autopilot_->Act(kTileSize, observation_.data(), memory_.data(), action_.data()); }
  void Step() {
    StepOutput output;
    output.reward = reward_.data();
    output.termination = termination_.data();
    output.episode_return = episode_return_.data();
    output.episode_steps = episode_steps_.data();
    env_.Step(0, action_.data(), output);
  }

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

  EnvConfig config_;
  VecEnv env_;
  std::unique_ptr<Policy> autopilot_;
  std::vector<std::uint32_t> start_;
  std::vector<float> observation_, memory_, action_, reward_, episode_return_;
  std::vector<std::uint8_t> termination_;
  std::vector<std::int32_t> episode_steps_;
};

const char* const kTasks[] = {"heading", "control", "tracking"};

void BM_Autopilot(benchmark::State& state) {
  const char* const task = kTasks[state.range(0)];
  FlownTile tile(task);
  Meter meter(&state, static_cast<double>(kTileSize) * kRounds);
  for (auto _ : state) {
    meter.Time([&] {
      for (int round = 0; round < kRounds; ++round) {
        tile.Act();
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
        tile.Step();
      }
    });
  }
  state.SetLabel(task);
  meter.Report();
}
BENCHMARK(BM_Environment)->ArgName("task")->DenseRange(0, 2)->UseManualTime();

}  // namespace
}  // namespace skein::bench
