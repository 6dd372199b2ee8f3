// SPDX-License-Identifier: Apache-2.0
#include "src/bench/simulator_rate.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "base/large_memory.h"
#include "base/median.h"
#include "base/seconds_since.h"
#include "envs/aircraft/engine.h"
#include "envs/aircraft/f16.h"
#include "envs/flight_reset.h"
#include "envs/kernels/flight_control_kernel.h"
#include "envs/kernels/plant_kernel.h"
#include "envs/step_memory.h"
#include "envs/vec_env.h"
#include "simd/random.h"

namespace skein {
namespace {

constexpr int kTileSize = 128;  // stays in the innermost caches
constexpr int kWarmUpSteps = 3;
constexpr double kDt = 0.02;

constexpr int kStepsOfTurn = 20;

double Time(const std::function<void()>& step) {
  const auto start = std::chrono::steady_clock::now();
  step();
  return SecondsSince(start);
}

SimulatorRate MedianRate(std::vector<double> seconds, int aircraft) {
  const double median = Median(seconds);
  return {median, aircraft / median, std::move(seconds)};
}

SimulatorRate Measure(int aircraft, int steps, const std::function<void()>& step) {
  for (int i = 0; i < kWarmUpSteps; ++i) step();
  std::vector<double> seconds;
  for (int i = 0; i < steps; ++i) seconds.push_back(Time(step));
  return MedianRate(std::move(seconds), aircraft);
}

/// Where the aircraft are spread: inside the envelope in which steady flight exists.
EnvConfig SpreadFlights() {
  EnvConfig config;
  config.control_interval_s = kDt;
  config.initial.altitude_ft = {10000, 25000};
  config.initial.true_airspeed_fps = {600, 1000};
  return config;
}

/// Aircraft in trimmed flight with stick commands, tile behind tile in memory.
class TrimmedFlock {
 public:
  /// Filled by the workers.
  TrimmedFlock(int count, WorkerPool& pool)
      : count_(count),
        memory_(static_cast<std::size_t>(num_tiles()) * kFloatsPerTile * sizeof(float)) {
    const EnvConfig config = SpreadFlights();
    const Aircraft f16 = F16();
    const FlightReset reset(config, f16);
    kernel_ = MakeKernelAircraft(f16, config.atmosphere);
    pool.ForEach(num_tiles(), [&](int tile, int) { Fill(reset, f16.throttle_gearing, tile); });
  }

  int num_tiles() const { return (count_ + kTileSize - 1) / kTileSize; }

  void Step(PlantPart part, int index) {
    const Tile tile = At(index);
    if (part == PlantPart::kFlightControlAndRk4) {
      const PilotColumns commands{tile[kNumColumns], tile[kNumColumns + 1], tile[kNumColumns + 2],
                                  tile[kNumColumns + 3]};
      ControlTile(*kernel_, tile, commands, FlightControlMode::kFull, static_cast<float>(kDt));
    }
    MemoryAhead ahead;
    if (index + 1 < num_tiles()) {
      ahead = {reinterpret_cast<const std::byte*>(At(index + 1).base),
               kFloatsPerTile * sizeof(float)};
    }
    StepTile(*kernel_, tile, static_cast<float>(kDt), 1, ahead);
  }

 private:
  static constexpr int kNumCommands = 4;
  static constexpr std::size_t kFloatsPerTile =
      (kNumColumns + kNumCommands) * TileStride(kTileSize);

  Tile At(int index) {
    return {
        reinterpret_cast<float*>(memory_.data()) + static_cast<std::size_t>(index) * kFloatsPerTile,
        TileStride(kTileSize), std::min(kTileSize, count_ - index * kTileSize)};
  }

  void Fill(const FlightReset& reset, const ThrottleGearing& gearing, int index) {
    const Tile tile = At(index);
    simd::RandomStream random(
        {0, static_cast<std::uint32_t>(index), 0, 0, simd::RandomPurpose::kInitialState});
    for (std::size_t i = 0; i < tile.stride; ++i) {
      const FreshFlight flight = reset.Draw(&random);
      for (int column = 0; column < kNumColumns; ++column) {
        tile[column][i] = flight.columns[static_cast<std::size_t>(column)];
      }
      // The sticks stay centred.
      for (int k = 0; k < kNumCommands; ++k) tile[kNumColumns + k][i] = 0;
      tile[kNumColumns][i] = static_cast<float>(ThrottleForPower(gearing, flight.columns[kPower]));
    }
  }

  int count_;
  LargeMemory memory_;
  std::shared_ptr<const KernelAircraft> kernel_;
};

/// An environment with what its workers hand it and get from it.
class SteppedEnvironment {
 public:
  SteppedEnvironment(const EnvConfig& config, int aircraft, WorkerPool& pool)
      : env_(config, aircraft, 1, kTileSize), pool_(pool) {
    const auto observations = static_cast<std::size_t>(env_.observation_size());
    const auto actions = static_cast<std::size_t>(env_.action_size());
    int largest = 0;
    for (int tile = 0; tile < env_.num_tiles(); ++tile) {
      largest = std::max(largest, env_.tile_count(tile));
    }
    const auto size = static_cast<std::size_t>(largest);
    // The same for every worker: what flies where does not change with who flies it.
    std::vector<float> drawn(size * actions);
    simd::RandomStream random({0, 0, 0, 0, simd::RandomPurpose::kActionNoise});
    for (float& action : drawn) action = static_cast<float>(random.Uniform(-1, 1));
    for (int worker = 0; worker < pool.threads(); ++worker) {
      workers_.push_back({std::vector<float>(size * observations), drawn,
                          StepMemory(largest, {env_.observation_size()})});
    }
  }

  void Step() {
    pool_.ForEach(env_.num_tiles(), [&](int tile, int worker) {
      Buffers& buffers = workers_[static_cast<std::size_t>(worker)];
      env_.Observe(tile, buffers.observation.data());
      env_.Step(tile, buffers.action.data(), buffers.memory.output());
    });
  }

 private:
  struct Buffers {
    std::vector<float> observation, action;
    StepMemory memory;
  };

  VecEnv env_;
  WorkerPool& pool_;
  std::vector<Buffers> workers_;
};

}  // namespace

SimulatorRate MeasurePlant(PlantPart part, int aircraft, int steps, WorkerPool& pool) {
  TrimmedFlock flock(aircraft, pool);
  return Measure(aircraft, steps, [&] {
    pool.ForEach(flock.num_tiles(), [&](int tile, int) { flock.Step(part, tile); });
  });
}

std::vector<SimulatorRate> MeasureEnvironments(const std::vector<EnvConfig>& configs, int aircraft,
                                               int steps, WorkerPool& pool) {
  std::vector<std::unique_ptr<SteppedEnvironment>> environments;
  for (const EnvConfig& config : configs) {
    environments.push_back(std::make_unique<SteppedEnvironment>(config, aircraft, pool));
    for (int i = 0; i < kWarmUpSteps; ++i) environments.back()->Step();
  }
  std::vector<std::vector<double>> seconds(configs.size());
  for (int done = 0; done < steps; done += kStepsOfTurn) {
    for (std::size_t k = 0; k < configs.size(); ++k) {
      // The first of a turn finds the other's columns in the caches.
      environments[k]->Step();
      for (int i = done; i < std::min(steps, done + kStepsOfTurn); ++i) {
        seconds[k].push_back(Time([&] { environments[k]->Step(); }) / configs[k].action_repeat);
      }
    }
  }
  std::vector<SimulatorRate> rates;
  for (std::vector<double>& times : seconds) {
    rates.push_back(MedianRate(std::move(times), aircraft));
  }
  return rates;
}

}  // namespace skein
