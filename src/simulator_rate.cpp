#include "src/simulator_rate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "envs/aircraft/engine.h"
#include "envs/aircraft/f16/f16.h"
#include "envs/aircraft/flight_control.h"
#include "envs/aircraft/flight_control_kernel.h"
#include "envs/dynamics/attitude.h"
#include "envs/dynamics/plant.h"
#include "envs/dynamics/plant_kernel.h"
#include "envs/dynamics/trim_table.h"
#include "envs/vec_env.h"
#include "simd/random.h"

namespace skein {
namespace {

constexpr int kTileSize = 256;
constexpr int kWarmUpSteps = 3;
constexpr double kDt = 0.02;
// Where the aircraft are spread: inside the envelope in which steady flight exists.
constexpr double kMinAltitudeFt = 10000, kMaxAltitudeFt = 25000;
constexpr double kMinSpeedFps = 600, kMaxSpeedFps = 1000;

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

/// A tile of aircraft in trimmed flight with its pilot's commands.
class TrimmedTile {
 public:
  TrimmedTile(const Aircraft& aircraft, const TrimTable& trims, AtmosphereModel atmosphere,
              int count, simd::RandomStream* random)
      : stride_(TileStride(count)),
        count_(count),
        columns_((kNumColumns + kNumPilot) * stride_ + kAlignment) {
    base_ = columns_.data();
    while (reinterpret_cast<std::uintptr_t>(base_) % (kAlignment * sizeof(float)) != 0) ++base_;
    const FlightControl control(aircraft, FlightControlMode::kFull, kDt);
    for (std::size_t i = 0; i < stride_; ++i) {
      const double altitude = random->Uniform(kMinAltitudeFt, kMaxAltitudeFt);
      const double speed = random->Uniform(kMinSpeedFps, kMaxSpeedFps);
      Fill(control, trims.At(altitude, speed), AirAt(atmosphere, altitude), altitude, speed, i);
    }
  }

  void Step(const KernelAircraft& kernel) {
    const Tile tile{base_, stride_, count_};
    const float* pilot = base_ + kNumColumns * stride_;
    ControlTile(kernel, tile, {pilot, pilot + stride_, pilot + 2 * stride_, pilot + 3 * stride_},
                FlightControlMode::kFull, static_cast<float>(kDt));
    StepTile(kernel, tile, static_cast<float>(kDt), 1);
  }

 private:
  static constexpr int kNumPilot = 4;
  static constexpr std::size_t kAlignment = 16;  // floats: one cache line

  void Fill(const FlightControl& control, const TrimmedStart& trim, const Air& air, double altitude,
            double speed, std::size_t i) {
    const auto set = [this, i](int column, double value) {
      base_[static_cast<std::size_t>(column) * stride_ + i] = static_cast<float>(value);
    };
    set(kU, speed * std::cos(trim.alpha_rad));
    set(kW, speed * std::sin(trim.alpha_rad));
    set(kDown, -altitude);
    const Eigen::Vector4d quaternion = QuaternionFromEuler({trim.bank_rad, trim.pitch_rad, 0});
    for (int k = 0; k < 4; ++k) set(kQ0 + k, quaternion[k]);
    set(kPower, trim.power);
    set(kPowerCommand, trim.power);
    set(kElevator, trim.elevator_deg);
    set(kAileron, trim.aileron_deg);
    set(kRudder, trim.rudder_deg);
    set(kLeadingEdgeFlap, trim.leading_edge_flap_deg);
    set(kNz, trim.nz);
    set(kNy, trim.ny);
    FlightSensors sensors;
    sensors.alpha_deg = trim.alpha_rad * kDegPerRad;
    sensors.nz = trim.nz;
    sensors.ny = trim.ny;
    sensors.dynamic_pressure_psf = 0.5 * air.density_slug_ft3 * speed * speed;
    sensors.static_pressure_psf = air.pressure_lbf_ft2;
    const FlightControlState state = control.InitialState(
        sensors,
        {trim.elevator_deg, trim.aileron_deg, trim.rudder_deg, trim.leading_edge_flap_deg});
    for (int k = 0; k < kNumFlightControlStates; ++k) {
      set(kAlphaFilter + k, state[static_cast<std::size_t>(k)]);
    }
    set(kNumColumns, ThrottleForPower(trim.power));  // sticks stay centred
  }

  std::size_t stride_;
  int count_;
  std::vector<float> columns_;
  float* base_ = nullptr;
};

}  // namespace

SimulatorRate MeasurePlant(int aircraft, int steps, WorkerPool& pool) {
  constexpr AtmosphereModel kAtmosphere = AtmosphereModel::kStevensLewis;
  const Plant plant(F16(), kAtmosphere);
  const TrimTable trims(plant, kMinAltitudeFt, kMaxAltitudeFt, kMinSpeedFps, kMaxSpeedFps);
  const auto kernel = MakeKernelAircraft(plant.aircraft(), kAtmosphere);
  std::vector<std::unique_ptr<TrimmedTile>> tiles(
      static_cast<std::size_t>((aircraft + kTileSize - 1) / kTileSize));
  const int count = static_cast<int>(tiles.size());
  // Made by the workers, so that pages and caches are first touched where they are used.
  pool.ForEach(count, [&](int tile, int) {
    simd::RandomStream random(
        {0, static_cast<std::uint32_t>(tile), 0, 0, simd::RandomPurpose::kInitialState});
    const int size = std::min(kTileSize, aircraft - tile * kTileSize);
    tiles[static_cast<std::size_t>(tile)] =
        std::make_unique<TrimmedTile>(plant.aircraft(), trims, kAtmosphere, size, &random);
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
