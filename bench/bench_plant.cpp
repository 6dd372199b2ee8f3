// Rates of the plant kernel: single evaluations and whole RK4 steps, in aircraft per
// second and as a fraction of the machine's measured multiply-add rate.

#include <benchmark/benchmark.h>

#include <algorithm>
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
#include "simd/peak.h"
#include "simd/target.h"

namespace skein {
namespace {

constexpr int kTileSize = 512;
constexpr float kDt = 0.02f;

/// Columns of a number of aircraft in tiles, aligned to cache lines, at random flight conditions of
/// the whole envelope: neighbours read different table cells, as in training. The state is restored
/// now and then, so that free flight does not leave the tables.
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

void Report(benchmark::State& state, int aircraft, double flops, int threads) {
  using benchmark::Counter;
  const double steps = static_cast<double>(state.iterations()) * aircraft;
  state.counters["aircraft_steps"] = Counter(steps, Counter::kIsRate);
  state.counters["of_peak"] =
      Counter(steps * flops / (PeakGflops(threads) * 1e9), Counter::kIsRate);
  state.SetLabel(simd::Name(simd::ActiveTarget()));
}

void BM_Rk4(benchmark::State& state) {
  constexpr int kStepsPerFlight = 100;
  Flock flock(static_cast<int>(state.range(0)));
  WorkerPool pool(static_cast<int>(state.range(1)));
  int step = 0;
  for (auto _ : state) {
    if (++step % kStepsPerFlight == 0) {
      state.PauseTiming();
      flock.Restart();
      state.ResumeTiming();
    }
    pool.ForEach(flock.tiles(),
                 [&](int tile, int) { StepTile(TestAircraft(), flock.At(tile), kDt, 1); });
  }
  Report(state, flock.count(), kFlopsPerRk4Step, pool.threads());
}
BENCHMARK(BM_Rk4)
    ->ArgNames({"aircraft", "threads"})
    ->Args({512, 1})
    ->Args({4096, 1})
    ->Args({4096, 2})
    ->Args({1000000, 1})
    ->Args({1000000, 2})
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

void BM_Evaluate(benchmark::State& state) {
  Flock flock(kTileSize);
  const Tile tile = flock.At(0);
  const std::vector<float> thrust(tile.stride, 5000);
  std::vector<float> rates(tile.stride * kNumRigidBody), coefficients(tile.stride * 6);
  const ControlColumns controls{thrust.data(), tile[kElevator], tile[kAileron], tile[kRudder],
                                tile[kLeadingEdgeFlap]};
  WorkerPool pool(1);
  for (auto _ : state) {
    pool.ForEach(1, [&](int, int) {
      EvaluateTile(TestAircraft(), tile, controls, rates.data(), coefficients.data());
    });
    benchmark::DoNotOptimize(rates.data());
  }
  Report(state, kTileSize, kFlopsPerEvaluation, 1);
}
BENCHMARK(BM_Evaluate)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace skein
