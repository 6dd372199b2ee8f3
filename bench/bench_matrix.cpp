// SPDX-License-Identifier: Apache-2.0
// The learner's matrix products on one core: custom GEMM in both precisions beside LibTorch's.
// All take turns in every iteration, as the machine's speed varies; rates are of the medians.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "base/median.h"
#include "bench/learner_meter.h"
#include "bench/libtorch_matmul.h"
#include "bench/seconds_of.h"
#include "simd/matrix_product.h"
#include "train/libtorch/libtorch_threads.h"

namespace skein::bench {
namespace {

using simd::Precision;

/// Times `own(precision)` and `libtorch()`, products of `multiply_adds`.
template <class Own, class LibTorch>
void Compare(benchmark::State& state, std::int64_t multiply_adds, const Own& own,
             const LibTorch& libtorch) {
  std::vector<double> float32, bfloat16, reference;  // seconds of each call
  for (auto _ : state) {
    reference.push_back(SecondsOf(libtorch));
    bfloat16.push_back(SecondsOf([&] { own(Precision::kBfloat16); }));
    float32.push_back(SecondsOf([&] { own(Precision::kFloat32); }));
    state.SetIterationTime(float32.back());
  }
  const auto flops = [&](const std::vector<double>& seconds) {
    return 2 * static_cast<double>(multiply_adds) / Median(seconds);
  };
  // Plain numbers: benchmark::Counter's rates would print with a unit of their own.
  state.counters["fp32_GFLOP/s"] = 1e-9 * flops(float32);
  state.counters["fp32_%_of_peak"] = 100 * flops(float32) / Peak(Precision::kFloat32);
  state.counters["bf16_GFLOP/s"] = 1e-9 * flops(bfloat16);
  state.counters["bf16_%_of_peak"] = 100 * flops(bfloat16) / Peak(Precision::kBfloat16);
  state.counters["LibTorch_GFLOP/s"] = 1e-9 * flops(reference);
  state.counters["fp32/LibTorch"] = Median(reference) / Median(float32);
}

/// Floats between rows: a cache line more than a row has, so that rows do not all fall into the
/// same sets of the cache.
std::int64_t Stride(std::int64_t columns) { return (columns + 15) / 16 * 16 + 16; }

/// out = A W^T, a layer forward: range = rows, depth, columns. Its backward by the input, dY W, is
/// the same kernel with depth and columns swapped.
void Layer(benchmark::State& state) {
  UseOneLibTorchThread();
  const std::int64_t rows = state.range(0), depth = state.range(1), columns = state.range(2);
  auto a = Normal(rows * Stride(depth)), weight = Normal(depth * columns);
  auto out = Normal(rows * Stride(columns));
  simd::PackedMatrix packed[2];
  for (const Precision precision : {Precision::kFloat32, Precision::kBfloat16}) {
    packed[static_cast<int>(precision)].Pack(depth, columns, weight.data(), 1, depth, precision);
  }
  simd::ProductWorkspace workspace;
  Compare(
      state, rows * depth * columns,
      [&](Precision precision) {
        simd::Multiply(rows, a.data(), Stride(depth), packed[static_cast<int>(precision)], nullptr,
                       0, out.data(), Stride(columns), &workspace);
      },
      [&] {
        MatMul({a.data(), rows, depth, Stride(depth)}, Transpose::kNo,
               {weight.data(), columns, depth, depth}, Transpose::kYes, false,
               {out.data(), rows, columns, Stride(columns)});
      });
}
BENCHMARK(Layer)
    ->ArgNames({"rows", "depth", "columns"})
    ->Args({384, 128, 128})
    ->Args({384, 128, 384})
    ->Args({384, 384, 128})
    ->Args({384, 22, 128})
    ->Args({384, 128, 4})
    ->Args({384, 128, 1})
    ->Args({384, 4, 128})
    ->Args({48, 128, 384})
    ->Args({48, 384, 128})
    ->Args({1024, 128, 128})
    ->Args({1024, 128, 384})
    ->UseManualTime();

/// gradient += dY^T X: range = rows, columns of dY (the layer's outputs), columns of X.
void WeightGradient(benchmark::State& state) {
  UseOneLibTorchThread();
  const std::int64_t rows = state.range(0), outputs = state.range(1), inputs = state.range(2);
  auto left = Normal(rows * Stride(outputs)), right = Normal(rows * Stride(inputs));
  auto gradient = Normal(outputs * inputs);
  simd::ProductWorkspace workspace;
  Compare(
      state, rows * outputs * inputs,
      [&](Precision precision) {
        simd::AddTransposedProduct(rows, left.data(), Stride(outputs), outputs, right.data(),
                                   Stride(inputs), inputs, precision, gradient.data(), inputs,
                                   &workspace);
      },
      [&] {
        MatMul({left.data(), rows, outputs, Stride(outputs)}, Transpose::kYes,
               {right.data(), rows, inputs, Stride(inputs)}, Transpose::kNo, true,
               {gradient.data(), outputs, inputs, inputs});
      });
}
BENCHMARK(WeightGradient)
    ->ArgNames({"rows", "outputs", "inputs"})
    ->Args({384, 128, 128})
    ->Args({384, 384, 128})
    ->Args({384, 128, 22})
    ->Args({384, 4, 128})
    ->Args({384, 1, 128})
    ->Args({1024, 128, 128})
    ->Args({1024, 384, 128})
    ->UseManualTime();

}  // namespace
}  // namespace skein::bench
