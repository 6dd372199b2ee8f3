// SPDX-License-Identifier: Apache-2.0
// What each level of the memory gives: the roofs of parts that pass more bytes than they compute.
// Every thread passes over floats of its own, by the active target's vectors. A pass that writes
// counts the bytes that the program writes, not those that a cache fetches before.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/aligned_vector.h"
#include "base/median.h"
#include "base/worker_pool.h"
#include "bench/memory_streams.h"
#include "bench/seconds_of.h"
#include "simd/peak.h"

namespace skein::bench {
namespace {

constexpr std::size_t kMultiple = 128;  // of which a stream has some floats

/// One thread's pass over its floats.
using Pass = void (*)(AlignedVector<float>* values);

/// Times `pass` over state.range(0) KiB on each of state.range(1) threads, `bytes_moved` times what
/// there is. Small streams are passed over again and again: a thread passes over 1 GB a call,
/// beside which it takes no time to wake it.
void Stream(benchmark::State& state, Pass pass, double bytes_moved) {
  const std::size_t bytes = static_cast<std::size_t>(state.range(0)) * 1024;
  const std::size_t count = bytes / sizeof(float) / kMultiple * kMultiple;
  WorkerPool pool(static_cast<int>(state.range(1)));
  const auto threads = static_cast<std::size_t>(pool.threads());
  std::vector<AlignedVector<float>> streams(threads, AlignedVector<float>(count, 1.0f));
  const int rounds = std::max(1, static_cast<int>(1'000'000'000 / bytes));
  std::vector<double> seconds;  // of each call
  for (auto _ : state) {
    seconds.push_back(SecondsOf([&] {
      pool.ForEach(pool.threads(), [&](int index, int) {
        for (int round = 0; round < rounds; ++round)
          pass(&streams[static_cast<std::size_t>(index)]);
      });
    }));
    state.SetIterationTime(seconds.back());
  }
  if (seconds.empty()) return;
  static const double clock = simd::MeasureClock();
  const double moved = bytes_moved * static_cast<double>(count * sizeof(float) * threads) * rounds;
  const double rate = moved / Median(seconds);
  // Plain numbers: benchmark::Counter's rates would print with a unit of their own.
  state.counters["GB/s"] = 1e-9 * rate;
  state.counters["bytes/cycle/core"] = rate / clock / static_cast<double>(threads);
}

void BM_Read(benchmark::State& state) {
  Stream(
      state,
      [](AlignedVector<float>* values) {
        benchmark::DoNotOptimize(ReadStream(values->data(), values->size()));
      },
      1);
}

void BM_Write(benchmark::State& state) {
  Stream(
      state,
      [](AlignedVector<float>* values) { WriteStream(values->data(), values->size(), 1.0f); }, 1);
}

/// Reads and writes every float in place, as a control step does with most of what it moves.
void BM_Update(benchmark::State& state) {
  Stream(
      state,
      [](AlignedVector<float>* values) { UpdateStream(values->data(), values->size(), 1.0f); }, 2);
}

/// The first level's half; the second's of 512 KB to 2 MB; the third's; memory.
void Sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"KiB", "threads"})->UseManualTime();
  for (const int kib : {16, 256, 4096, 262144}) {
    for (const int threads : {1, 2}) benchmark->Args({kib, threads});
  }
}
BENCHMARK(BM_Read)->Apply(Sizes);
BENCHMARK(BM_Write)->Apply(Sizes);
BENCHMARK(BM_Update)->Apply(Sizes);

}  // namespace
}  // namespace skein::bench
