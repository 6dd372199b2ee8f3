// Rates of the learner's parts: gradients of a tile by each backend, and inference of a rollout's
// tile, in samples per second and as a fraction of the machine's measured multiply-add rate.

#include <benchmark/benchmark.h>

#include <memory>
#include <random>
#include <vector>

#include "simd/peak.h"
#include "train/recurrent_network.h"

namespace skein {
namespace {

constexpr int kChunkLength = 8;
constexpr int kObservationSize = 22, kActionSize = 4;

std::vector<float> Normal(std::int64_t count, float scale) {
  static std::mt19937 generator(1);
  std::normal_distribution<float> normal(0, scale);
  std::vector<float> values(count);
  for (float& value : values) value = normal(generator);
  return values;
}

/// Reports samples per second, and their floating-point operations against the peak of one core.
void Report(benchmark::State& state, std::int64_t samples, double flops_per_sample) {
  static const double peak = simd::MeasurePeak(1).gflops_per_core * 1e9;
  const auto total = static_cast<double>(state.iterations() * samples);
  state.counters["samples/s"] = benchmark::Counter(total, benchmark::Counter::kIsRate);
  state.counters["of_peak"] =
      benchmark::Counter(total * flops_per_sample / peak, benchmark::Counter::kIsRate);
}

/// Forward, losses and backward of actor and critic on one tile of `range(0)` samples.
void Gradient(benchmark::State& state, Backend backend) {
  const int batch = static_cast<int>(state.range(0)) / kChunkLength;
  const std::int64_t rows = static_cast<std::int64_t>(batch) * kChunkLength;
  const NetworkConfig config;
  const NetworkLayout layouts[2] = {
      NetworkLayout(ActorShape(config, kObservationSize, kActionSize)),
      NetworkLayout(CriticShape(config, kObservationSize))};
  const auto observation = Normal(rows * kObservationSize, 1);
  const auto initial_state = Normal(static_cast<std::int64_t>(batch) * config.gru_size, 0.3f);
  const auto action = Normal(rows * kActionSize, 1);
  const auto advantage = Normal(rows, 1), target = Normal(rows, 1);
  const std::vector<float> keep(rows, 1.0f), log_prob(rows, -5.5f);
  SampleTile tile;
  tile.sequence = {kChunkLength, batch, observation.data(), initial_state.data(), keep.data()};
  tile.actor = {action.data(), log_prob.data(), advantage.data()};
  tile.target = tile.old_value = target.data();
  LossSettings settings;
  settings.sample_weight = 1.0 / static_cast<double>(rows);

  std::unique_ptr<RecurrentNetwork> networks[2];
  NetworkWorkspace workspace;
  std::vector<float> accumulators[2];
  double flops = 0;
  for (int i = 0; i < 2; ++i) {
    networks[i] = MakeNetwork(backend, layouts[i]);
    networks[i]->SetParameters(InitialParameters(layouts[i], 0.01, 0, 1, 0).data());
    accumulators[i].resize(networks[i]->accumulator_size());
    flops += 3 * ForwardFlops(layouts[i].shape());
  }
  for (auto _ : state) {
    for (int i = 0; i < 2; ++i) {
      benchmark::DoNotOptimize(
          networks[i]->AccumulateGradient(tile, settings, workspace, accumulators[i].data()));
    }
  }
  Report(state, rows, flops);
}
BENCHMARK_CAPTURE(Gradient, fused, Backend::kFused)
    ->RangeMultiplier(2)
    ->Range(256, 4096)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Gradient, libtorch, Backend::kLibTorch)
    ->Arg(1024)
    ->Arg(4096)
    ->Unit(benchmark::kMillisecond);

/// One decision of actor and critic for a rollout tile of `range(0)` aircraft.
void Inference(benchmark::State& state) {
  const int batch = static_cast<int>(state.range(0));
  const NetworkConfig config;
  const auto observation = Normal(static_cast<std::int64_t>(batch) * kObservationSize, 1);
  const auto initial_state = Normal(static_cast<std::int64_t>(batch) * config.gru_size, 0.3f);
  const std::vector<float> keep(batch, 1.0f);
  std::vector<std::unique_ptr<RecurrentNetwork>> networks;
  double flops = 0;
  for (const NetworkShape& shape :
       {ActorShape(config, kObservationSize, kActionSize), CriticShape(config, kObservationSize)}) {
    networks.push_back(MakeNetwork(Backend::kFused, NetworkLayout(shape)));
    networks.back()->SetParameters(
        InitialParameters(networks.back()->layout(), 0.01, 0, 1, 0).data());
    flops += ForwardFlops(shape);
  }
  NetworkWorkspace workspace;
  for (auto _ : state) {
    for (const auto& network : networks) {
      network->Forward({1, batch, observation.data(), initial_state.data(), keep.data()},
                       workspace);
      benchmark::DoNotOptimize(workspace.output());
    }
  }
  Report(state, batch, flops);
}
BENCHMARK(Inference)->RangeMultiplier(2)->Range(64, 1024)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace skein
