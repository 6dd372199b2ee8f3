// SPDX-License-Identifier: Apache-2.0
// Times of what a minibatch does once, whatever its size, for one network: the actor of the default
// settings.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "base/denormals.h"
#include "bench/learner_meter.h"
#include "train/network/folded_parameters.h"
#include "train/network/fused_network.h"
#include "train/ppo/adam.h"
#include "train/ppo/clipped_step.h"
#include "train/ppo/gradient_sums.h"

namespace skein::bench {
namespace {

constexpr double kMinSeconds = 0.1;

NetworkLayout Actor() { return NetworkLayout(ActorShape(NetworkConfig(), 22, 4)); }

/// Times `call()`, which passes over `values` values.
template <class Call>
void Once(benchmark::State& state, std::int64_t values, const Call& call) {
  const DenormalsFlushed flushed;
  LearnerMeter meter(&state, 0);
  for (auto _ : state) meter.Time(call);
  meter.ReportCyclesPerValue(values);
}

/// A weight of `range(0)` outputs and `range(1)` inputs, as products forward read it.
void PackForward(benchmark::State& state, simd::Precision precision) {
  const std::int64_t outputs = state.range(0), inputs = state.range(1);
  const auto weight = Normal(outputs * inputs);
  simd::PackedMatrix packed;
  Once(state, outputs * inputs,
       [&] { packed.Pack(inputs, outputs, weight.data(), 1, inputs, precision); });
}
/// As products backward read it.
void PackBackward(benchmark::State& state, simd::Precision precision) {
  const std::int64_t outputs = state.range(0), inputs = state.range(1);
  const auto weight = Normal(outputs * inputs);
  simd::PackedMatrix packed;
  Once(state, outputs * inputs,
       [&] { packed.Pack(outputs, inputs, weight.data(), inputs, 1, precision); });
}

void Fold(benchmark::State& state) {
  const NetworkLayout layout = Actor();
  const FoldedLayout folded_layout(layout);
  const auto parameters = Normal(layout.size());
  AlignedVector<float> folded(folded_layout.size());
  Once(state, layout.size(), [&] {
    folded_layout.ForEachLinear(
        [&](const FoldedLinear& linear) { FoldLinear(linear, parameters.data(), folded.data()); });
  });
}

void UnfoldGradient(benchmark::State& state) {
  const NetworkLayout layout = Actor();
  const FoldedLayout folded_layout(layout);
  const auto parameters = Normal(layout.size()), folded_gradient = Normal(folded_layout.size());
  AlignedVector<float> gradient(layout.size());
  Once(state, layout.size(), [&] {
    folded_layout.UnfoldGradient(parameters.data(), folded_gradient.data(), gradient.data());
  });
}

/// Folding and packing of everything.
void SetParameters(benchmark::State& state, simd::Precision precision) {
  const NetworkLayout layout = Actor();
  FusedNetwork network(layout, {precision, precision});
  const auto parameters = Normal(layout.size());
  Once(state, layout.size(), [&] { network.SetParameters(parameters.data()); });
}

void SumGradients(benchmark::State& state) {
  const std::int64_t slices = state.range(0);
  std::vector<AlignedVector<float>> gradients;
  for (std::int64_t i = 0; i < slices; ++i) gradients.push_back(Normal(Actor().size()));
  const auto size = static_cast<std::int64_t>(gradients[0].size());
  Once(state, size * (slices - 1), [&] {
    for (std::int64_t i = 0; i < size; i += kSumBlock) {
      skein::SumGradients(i, std::min(size, i + kSumBlock), static_cast<int>(slices), gradients);
    }
  });
}

/// Norm, clipping and Adam.
void ClippedStep(benchmark::State& state) {
  const std::int64_t size = Actor().size();
  const auto parameters = Normal(size), gradient = Normal(size);
  AdamOptimiser adam({parameters.begin(), parameters.end()}, 1e-5);
  std::copy(gradient.begin(), gradient.end(), adam.gradient());
  Once(state, size, [&] { benchmark::DoNotOptimize(skein::ClippedStep(1, 1e-6, adam)); });
}

/// Adam alone.
void AdamStep(benchmark::State& state) {
  const std::int64_t size = Actor().size();
  const auto parameters = Normal(size), gradient = Normal(size);
  AdamOptimiser adam({parameters.begin(), parameters.end()}, 1e-5);
  std::copy(gradient.begin(), gradient.end(), adam.gradient());
  Once(state, size, [&] { adam.Step(1e-6); });
}

#define SKEIN_ONCE(part) part->UseManualTime()->MinTime(kMinSeconds)
SKEIN_ONCE(BENCHMARK_CAPTURE(PackForward, fp32, simd::Precision::kFloat32))->Args({384, 128});
SKEIN_ONCE(BENCHMARK_CAPTURE(PackForward, bf16, simd::Precision::kBfloat16))->Args({384, 128});
SKEIN_ONCE(BENCHMARK_CAPTURE(PackBackward, fp32, simd::Precision::kFloat32))->Args({384, 128});
SKEIN_ONCE(BENCHMARK_CAPTURE(PackBackward, bf16, simd::Precision::kBfloat16))->Args({384, 128});
SKEIN_ONCE(BENCHMARK(Fold));
SKEIN_ONCE(BENCHMARK_CAPTURE(SetParameters, fp32, simd::Precision::kFloat32));
SKEIN_ONCE(BENCHMARK_CAPTURE(SetParameters, bf16, simd::Precision::kBfloat16));
SKEIN_ONCE(BENCHMARK(SumGradients))->Arg(16);
SKEIN_ONCE(BENCHMARK(UnfoldGradient));
SKEIN_ONCE(BENCHMARK(ClippedStep));
SKEIN_ONCE(BENCHMARK(AdamStep));
#undef SKEIN_ONCE

}  // namespace
}  // namespace skein::bench
