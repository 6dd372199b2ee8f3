// Rates of the plant kernel: single evaluations and whole RK4 steps, in aircraft per
// second and as a fraction of the machine's measured multiply-add rate.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <vector>

#include "envs/aircraft/f16/f16.h"
#include "envs/dynamics/plant_kernel.h"
#include "envs/worker_pool.h"
#include "simd/denormals.h"
#include "simd/peak.h"
#include "simd/target.h"

namespace skein {
namespace {

constexpr int kTileSize = 512;
constexpr float kDt = 0.02f;

/// Columns of a number of aircraft in tiles, aligned to cache lines, at random flight conditions of
/// the whole envelope: neighbours read different table cells, as in training. Flights without
/// control leave the tables sooner or later: Restart.
class Flock {
 public:
  explicit Flock(int count) : count_(count), stride_(TileStride(std::min(count, kTileSize))) {
    const std::size_t size = static_cast<std::size_t>(tiles()) * tile_floats();
    values_.resize(size + kAlignment);
    base_ = values_.data();
    while (reinterpret_cast<std::uintptr_t>(base_) % (kAlignment * sizeof(float)) != 0) ++base_;
    std::mt19937 random(1);
    const auto uniform = [&](float low, float high) {
      return std::uniform_real_distribution<float>(low, high)(random);
    };
    for (int t = 0; t < tiles(); ++t) {
      const Tile tile = At(t);
      for (std::size_t i = 0; i < stride_; ++i) {
        const float speed = uniform(400, 1000), alpha = uniform(-0.05f, 0.35f);
        tile[kU][i] = speed * std::cos(alpha);
        tile[kV][i] = uniform(-30, 30);
        tile[kW][i] = speed * std::sin(alpha);
        for (const int rate : {kP, kQ, kR}) tile[rate][i] = uniform(-0.1f, 0.1f);
        tile[kDown][i] = -uniform(5000, 40000);
        const float bank = uniform(-0.7f, 0.7f);
        tile[kQ0][i] = std::cos(bank / 2);
        tile[kQx][i] = std::sin(bank / 2);
        tile[kPower][i] = uniform(0, 100);
        tile[kPowerCommand][i] = uniform(0, 100);
        tile[kElevator][i] = uniform(-5, 5);
        tile[kLeadingEdgeFlap][i] = uniform(0, 25);
      }
    }
    start_ = values_;
  }

  int tiles() const { return (count_ + kTileSize - 1) / kTileSize; }
  int count() const { return count_; }
  Tile At(int t) {
    return {base_ + static_cast<std::size_t>(t) * tile_floats(), stride_,
            std::min(kTileSize, count_ - t * kTileSize)};
  }
  void Restart() { std::copy(start_.begin(), start_.end(), values_.begin()); }

 private:
  static constexpr std::size_t kAlignment = 16;
  std::size_t tile_floats() const { return stride_ * kNumColumns; }

  int count_;
  std::size_t stride_;
  std::vector<float> values_, start_;
  float* base_ = nullptr;
};

const KernelAircraft& TestAircraft() {
  static const auto aircraft = MakeKernelAircraft(F16(), AtmosphereModel::kStevensLewis);
  return *aircraft;
}

double PeakGflops(int threads) {
  static std::map<int, double> measured;
  const auto found = measured.find(threads);
  if (found != measured.end()) return found->second;
  return measured[threads] = simd::MeasurePeak(threads).gflops;
}

/// Times the calls that it is given, and reports them as aircraft per second and as the share of
/// the measured multiply-add rate of as many threads that their operations use.
class Meter {
 public:
  Meter(benchmark::State* state, int aircraft, double flops_per_aircraft, int threads)
      : state_(*state), aircraft_(aircraft), flops_(flops_per_aircraft), threads_(threads) {}

  template <class Call>
  void Time(const Call& call) {
    const auto start = Clock::now();
    call();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    state_.SetIterationTime(seconds);
    seconds_ += seconds;
  }

  void Report() const {
    const double rate = static_cast<double>(state_.iterations()) * aircraft_ / seconds_;
    state_.counters["aircraft_per_s"] = rate;
    state_.counters["fraction_of_peak"] = rate * flops_ / (PeakGflops(threads_) * 1e9);
    state_.SetLabel(simd::Name(simd::ActiveTarget()));
  }

 private:
  using Clock = std::chrono::steady_clock;

  benchmark::State& state_;
  int aircraft_;
  double flops_;
  int threads_;
  double seconds_ = 0;
};

void BM_Rk4(benchmark::State& state) {
  constexpr int kStepsPerFlight = 100;
  Flock flock(static_cast<int>(state.range(0)));
  WorkerPool pool(static_cast<int>(state.range(1)));
  Meter meter(&state, flock.count(), kFlopsPerRk4Step, pool.threads());
  int step = 0;
  for (auto _ : state) {
    if (++step % kStepsPerFlight == 0) flock.Restart();
    meter.Time([&] {
      pool.ForEach(flock.tiles(),
                   [&](int tile, int) { StepTile(TestAircraft(), flock.At(tile), kDt, 1); });
    });
  }
  meter.Report();
}
BENCHMARK(BM_Rk4)
    ->ArgNames({"aircraft", "threads"})
    ->Args({512, 1})
    ->Args({4096, 1})
    ->Args({4096, 2})
    ->Args({1000000, 1})
    ->Args({1000000, 2})
    ->Unit(benchmark::kMicrosecond)
    ->UseManualTime();

void BM_Evaluate(benchmark::State& state) {
  Flock flock(kTileSize);
  const Tile tile = flock.At(0);
  const std::vector<float> thrust(tile.stride, 5000);
  std::vector<float> rates(tile.stride * kNumRigidBody), coefficients(tile.stride * 6);
  const ControlColumns controls{thrust.data(), tile[kElevator], tile[kAileron], tile[kRudder],
                                tile[kLeadingEdgeFlap]};
  const simd::DenormalsFlushed flushed;  // as on the environment's workers
  Meter meter(&state, kTileSize, kFlopsPerEvaluation, 1);
  for (auto _ : state) {
    meter.Time(
        [&] { EvaluateTile(TestAircraft(), tile, controls, rates.data(), coefficients.data()); });
    benchmark::DoNotOptimize(rates.data());
  }
  meter.Report();
}
BENCHMARK(BM_Evaluate)->Unit(benchmark::kMicrosecond)->UseManualTime();

}  // namespace
}  // namespace skein
