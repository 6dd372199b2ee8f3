#include "src/simulator_rate.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "envs/aircraft/engine.h"
#include "envs/aircraft/f16/f16.h"
#include "envs/aircraft/flight_control_kernel.h"
#include "envs/dynamics/plant_kernel.h"
#include "envs/flight_reset.h"
#include "envs/vec_env.h"
#include "simd/random.h"
#include "train/aligned_vector.h"

namespace skein {
namespace {

constexpr int kTileSize = 256;
constexpr int kWarmUpSteps = 3;
constexpr double kDt = 0.02;

SimulatorRate Measure(int aircraft, int steps, const std::function<void()>& step) {
  using Clock = std::chrono::steady_clock;
  for (int i = 0; i < kWarmUpSteps; ++i) step();
  std::vector<double> seconds;
  for (int i = 0; i < steps; ++i) {
    const auto start = Clock::now();
    step();
    seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
  }
  const auto middle = seconds.begin() + steps / 2;
  std::nth_element(seconds.begin(), middle, seconds.end());
  return {*middle, aircraft / *middle};
}

/// Where the aircraft are spread: inside the envelope in which steady flight exists.
EnvConfig SpreadFlights() {
  EnvConfig config;
  config.control_interval_s = kDt;
  config.initial.altitude_ft = {10000, 25000};
  config.initial.true_airspeed_fps = {600, 1000};
  return config;
}

/// A tile of aircraft in trimmed flight with its pilot's commands.
class TrimmedTile {
 public:
  TrimmedTile(const FlightReset& reset, int count, simd::RandomStream* random)
      : stride_(TileStride(count)), count_(count), columns_((kNumColumns + kNumPilot) * stride_) {
    for (std::size_t i = 0; i < stride_; ++i) {
      const FreshFlight flight = reset.Draw(random);
      for (std::size_t column = 0; column < kNumColumns; ++column) {
        columns_[column * stride_ + i] = flight.columns[column];
      }
      // The sticks stay centred.
      columns_[kNumColumns * stride_ + i] =
          static_cast<float>(ThrottleForPower(flight.columns[kPower]));
    }
  }

  void Step(const KernelAircraft& kernel) {
    const Tile tile{columns_.data(), stride_, count_};
    const float* pilot = columns_.data() + kNumColumns * stride_;
    ControlTile(kernel, tile, {pilot, pilot + stride_, pilot + 2 * stride_, pilot + 3 * stride_},
                FlightControlMode::kFull, static_cast<float>(kDt));
    StepTile(kernel, tile, static_cast<float>(kDt), 1);
  }

 private:
  static constexpr int kNumPilot = 4;

  std::size_t stride_;
  int count_;
  AlignedVector<float> columns_;
};

}  // namespace

SimulatorRate MeasurePlant(int aircraft, int steps, WorkerPool& pool) {
  const EnvConfig config = SpreadFlights();
  const Aircraft f16 = F16();
  const FlightReset reset(config, f16);
  const auto kernel = MakeKernelAircraft(f16, config.atmosphere);
  std::vector<std::unique_ptr<TrimmedTile>> tiles(
      static_cast<std::size_t>((aircraft + kTileSize - 1) / kTileSize));
  const int count = static_cast<int>(tiles.size());
  // Made by the workers, so that pages and caches are first touched where they are used.
  pool.ForEach(count, [&](int tile, int) {
    simd::RandomStream random(
        {0, static_cast<std::uint32_t>(tile), 0, 0, simd::RandomPurpose::kInitialState});
    const int size = std::min(kTileSize, aircraft - tile * kTileSize);
    tiles[static_cast<std::size_t>(tile)] = std::make_unique<TrimmedTile>(reset, size, &random);
  });
  return Measure(aircraft, steps, [&] {
    pool.ForEach(count,
                 [&](int tile, int) { tiles[static_cast<std::size_t>(tile)]->Step(*kernel); });
  });
}

SimulatorRate MeasureEnvironment(const EnvConfig& config, int aircraft, int steps,
                                 WorkerPool& pool) {
  EnvConfig single = config;
  single.action_repeat = 1;
  VecEnv env(single, aircraft, 1, kTileSize);
  const auto observations = static_cast<std::size_t>(env.observation_size());
  const auto actions = static_cast<std::size_t>(env.action_size());
  struct Buffers {
    std::vector<float> observation, action, reward, episode_return, final_observation;
    std::vector<std::uint8_t> termination;
    std::vector<std::int32_t> episode_steps;
  };
  std::vector<Buffers> workers(static_cast<std::size_t>(pool.threads()));
  int largest = 0;
  for (int tile = 0; tile < env.num_tiles(); ++tile) {
    largest = std::max(largest, env.tile_count(tile));
  }
  const auto size = static_cast<std::size_t>(largest);
  simd::RandomStream random({0, 0, 0, 0, simd::RandomPurpose::kActionNoise});
  for (Buffers& buffers : workers) {
    buffers = {std::vector<float>(size * observations),
               std::vector<float>(size * actions),
               std::vector<float>(size),
               std::vector<float>(size),
               std::vector<float>(size * observations),
               std::vector<std::uint8_t>(size),
               std::vector<std::int32_t>(size)};
    for (float& action : buffers.action) action = static_cast<float>(random.Uniform(-1, 1));
  }
  return Measure(aircraft, steps, [&] {
    pool.ForEach(env.num_tiles(), [&](int tile, int worker) {
      Buffers& buffers = workers[static_cast<std::size_t>(worker)];
      env.Observe(tile, buffers.observation.data());
      env.Step(tile, buffers.action.data(),
               {buffers.reward.data(), buffers.termination.data(), buffers.episode_return.data(),
                buffers.episode_steps.data(), buffers.final_observation.data()});
    });
  });
}

}  // namespace skein
