// SPDX-License-Identifier: Apache-2.0
// Rates of the learner's whole computations: gradients of a tile, inference of a rollout's tile,
// and the GRU alone. Its parts are in learner_kernels.cpp and learner_step.cpp; whole iterations
// are measured by `skein bench iteration`.

#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

#include "base/denormals.h"
#include "bench/learner_meter.h"
#include "train/network/backend_module.h"

namespace skein::bench {
namespace {

constexpr int kChunkLength = 8;
constexpr int kObservationSize = 22, kActionSize = 4;

/// The smallest time of one benchmark: there are many.
constexpr double kMinSeconds = 0.2;

std::vector<NetworkShape> ActorAndCritic() {
  const NetworkConfig config;
  return {ActorShape(config, kObservationSize, kActionSize), CriticShape(config, kObservationSize)};
}

/// Seconds per sample that products of one network take at the peak; backward in chunks of
/// kChunkLength.
double ForwardSeconds(const NetworkShape& shape, const NetworkPrecision& precision) {
  return ForwardFlops(NetworkLayout(shape)) / Peak(precision.forward);
}
double BackwardSeconds(const NetworkShape& shape, const NetworkPrecision& precision) {
  return BackwardFlops(NetworkLayout(shape), kChunkLength) / Peak(precision.backward);
}

/// Random samples of `batch` chunks for networks of the shape.
struct Samples {
  Samples(const NetworkShape& shape, int batch, int steps)
      : observation(Normal(Rows(batch, steps) * shape.observation_size)),
        initial_state(Normal(Rows(batch, 1) * shape.state_size(), 0.3f)),
        action(Normal(Rows(batch, steps) * kActionSize)),
        advantage(Normal(Rows(batch, steps))),
        target(Normal(Rows(batch, steps))),
        not_done(Rows(batch, steps), 1.0f),
        log_prob(Rows(batch, steps), -5.5f) {
    tile.sequence = {steps, batch, observation.data(), initial_state.data(), not_done.data()};
    tile.actor = {action.data(), log_prob.data(), advantage.data()};
    tile.target = tile.old_value = target.data();
    settings.sample_weight = 1.0 / static_cast<double>(tile.sequence.rows());
  }
  static std::int64_t Rows(int batch, int steps) {
    return static_cast<std::int64_t>(batch) * steps;
  }

  AlignedVector<float> observation, initial_state, action, advantage, target;
  std::vector<float> not_done, log_prob;
  SampleTile tile;
  LossSettings settings;
};

std::unique_ptr<RecurrentNetwork> FreshNetwork(Backend backend, const NetworkShape& shape,
                                               const NetworkPrecision& precision) {
  const NetworkLayout layout(shape);
  auto network = MakeNetwork(backend, layout, precision);
  network->SetParameters(InitialParameters(layout, 0.01, 0, 1, 0).data());
  return network;
}

NetworkPrecision PrecisionOf(int network, LearnerPrecision precision) {
  return network == 0 ? ActorPrecision(precision) : CriticPrecision(precision);
}

/// Forward, losses and backward of actor and critic on one tile of `range(0)` samples.
void Gradient(benchmark::State& state, Backend backend, LearnerPrecision precision) {
  if (backend == Backend::kLibTorch && LibTorchVersion().empty()) {
    state.SkipWithError("built without LibTorch");
    return;
  }
  const DenormalsFlushed flushed;
  const std::vector<NetworkShape> shapes = ActorAndCritic();
  const Samples samples(shapes[0], static_cast<int>(state.range(0)) / kChunkLength, kChunkLength);
  const std::int64_t rows = samples.tile.sequence.rows();
  std::unique_ptr<RecurrentNetwork> networks[2];
  AlignedVector<float> accumulators[2];
  NetworkWorkspace workspace;
  double peak_seconds = 0;
  for (int i = 0; i < 2; ++i) {
    const NetworkPrecision own = PrecisionOf(i, precision);
    networks[i] = FreshNetwork(backend, shapes[i], own);
    accumulators[i].resize(networks[i]->accumulator_size());
    peak_seconds += static_cast<double>(rows) *
                    (ForwardSeconds(shapes[i], own) + BackwardSeconds(shapes[i], own));
  }
  LearnerMeter meter(&state, rows, peak_seconds);
  for (auto _ : state) {
    meter.Time([&] {
      for (int i = 0; i < 2; ++i) {
        benchmark::DoNotOptimize(networks[i]->AccumulateGradient(
            samples.tile, samples.settings, workspace, accumulators[i].data()));
      }
    });
  }
  meter.Report();
}
#define SKEIN_GRADIENT(name, backend, precision) \
  BENCHMARK_CAPTURE(Gradient, name, backend, precision)->UseManualTime()->MinTime(kMinSeconds)
SKEIN_GRADIENT(fp32, Backend::kFused, LearnerPrecision::kFloat32)
    ->ArgsProduct({{192, 384, 768, 1536, 4096}});
SKEIN_GRADIENT(mixed, Backend::kFused, LearnerPrecision::kMixed)->Arg(384);
SKEIN_GRADIENT(bf16, Backend::kFused, LearnerPrecision::kBfloat16)->Arg(384);
SKEIN_GRADIENT(fast, Backend::kFused, LearnerPrecision::kFast)->Arg(384);
SKEIN_GRADIENT(libtorch, Backend::kLibTorch, LearnerPrecision::kFloat32)->Arg(384)->Arg(4096);
#undef SKEIN_GRADIENT

/// One policy step of actor and critic for a rollout tile of `range(0)` aircraft.
void Inference(benchmark::State& state, LearnerPrecision precision) {
  const DenormalsFlushed flushed;
  const std::vector<NetworkShape> shapes = ActorAndCritic();
  const int batch = static_cast<int>(state.range(0));
  const Samples samples(shapes[0], batch, 1);
  std::vector<std::unique_ptr<RecurrentNetwork>> networks;
  NetworkWorkspace workspace;
  double peak_seconds = 0;
  for (int i = 0; i < 2; ++i) {
    const NetworkPrecision own = PrecisionOf(i, precision);
    networks.push_back(FreshNetwork(Backend::kFused, shapes[i], own));
    peak_seconds += batch * ForwardSeconds(shapes[i], own);
  }
  LearnerMeter meter(&state, batch, peak_seconds);
  for (auto _ : state) {
    meter.Time([&] {
      for (const auto& network : networks) {
        network->Forward(samples.tile.sequence, workspace);
        benchmark::DoNotOptimize(workspace.output());
      }
    });
  }
  meter.Report();
}
BENCHMARK_CAPTURE(Inference, fp32, LearnerPrecision::kFloat32)
    ->RangeMultiplier(2)
    ->Range(64, 512)
    ->UseManualTime()
    ->MinTime(kMinSeconds);
BENCHMARK_CAPTURE(Inference, bf16, LearnerPrecision::kBfloat16)
    ->Arg(64)
    ->UseManualTime()
    ->MinTime(kMinSeconds);

/// The GRU on one tile of 48 chunks: a critic without hidden layers, whose observation is as wide
/// as a layer. Beside the GRU that leaves two LayerNorms and a head of one output; backward lacks
/// the gradient with respect to the GRU's input.
void GruChunk(benchmark::State& state, simd::Precision precision, bool backward) {
  const DenormalsFlushed flushed;
  constexpr int kBatch = 48;
  NetworkShape shape;
  shape.hidden_layers = 0;
  shape.hidden_size = shape.gru_size = shape.observation_size = 128;
  shape.output_size = 1;
  const Samples samples(shape, kBatch, kChunkLength);
  const auto rows = static_cast<double>(samples.tile.sequence.rows());
  const NetworkPrecision both{precision, precision};
  const auto network = FreshNetwork(Backend::kFused, shape, both);
  AlignedVector<float> accumulator(network->accumulator_size());
  NetworkWorkspace workspace;
  double peak_seconds = rows * ForwardSeconds(shape, both);
  if (backward) peak_seconds += rows * BackwardSeconds(shape, both);
  LearnerMeter meter(&state, samples.tile.sequence.rows(), peak_seconds);
  for (auto _ : state) {
    meter.Time([&] {
      if (backward) {
        benchmark::DoNotOptimize(network->AccumulateGradient(samples.tile, samples.settings,
                                                             workspace, accumulator.data()));
      } else {
        network->Forward(samples.tile.sequence, workspace);
        benchmark::DoNotOptimize(workspace.output());
      }
    });
  }
  meter.Report();
}
#define SKEIN_GRU_CHUNK(name, precision, backward) \
  BENCHMARK_CAPTURE(GruChunk, name, precision, backward)->UseManualTime()->MinTime(kMinSeconds)
SKEIN_GRU_CHUNK(forward_fp32, simd::Precision::kFloat32, false);
SKEIN_GRU_CHUNK(forward_backward_fp32, simd::Precision::kFloat32, true);
SKEIN_GRU_CHUNK(forward_bf16, simd::Precision::kBfloat16, false);
SKEIN_GRU_CHUNK(forward_backward_bf16, simd::Precision::kBfloat16, true);
#undef SKEIN_GRU_CHUNK

}  // namespace
}  // namespace skein::bench
