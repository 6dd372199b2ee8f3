// SPDX-License-Identifier: Apache-2.0
// Rates of the elementwise kernels between the learner's products
// (train/network/network_kernels.h), on rows that stay in the first two levels of the cache, as
// many as the networks give them.

#include <benchmark/benchmark.h>

#include "base/denormals.h"
#include "bench/learner_meter.h"
#include "train/network/network_kernels.h"

namespace skein::bench {
namespace {

constexpr int kObservationSize = 22, kColumns = 128, kActionSize = 4;
constexpr std::int64_t kRows = 96;    // of a block of the networks
constexpr std::int64_t kChunks = 48;  // of a tile: rows of one step of the GRU
constexpr double kMinSeconds = 0.1;
// Timed together: many times what reading the clock takes.
constexpr int kRounds = 16;

/// What the kernels read and write. Values go through some of them again and again: their time does
/// not depend on what they are.
struct Rows {
  AlignedVector<float> a = Normal(kRows * RowStride(kColumns));
  AlignedVector<float> b = Normal(kRows * RowStride(kColumns));
  AlignedVector<float> gates = Normal(kRows * gate_stride);
  AlignedVector<float> inverse_std = AlignedVector<float>(kRows, 1.0f);
  AlignedVector<float> zero_level = AlignedVector<float>(kRows, 0.0f);
  AlignedVector<float> not_done = AlignedVector<float>(kRows, 1.0f);
  AlignedVector<float> sums = AlignedVector<float>(4 * kColumns, 0.0f);

  static constexpr std::int64_t gate_stride = 4 * kColumns + 16;
};

/// Times kRounds calls of `kernel(rows)`, each of which passes over `count` rows of `columns`
/// values.
template <class Kernel>
void Pass(benchmark::State& state, std::int64_t count, int columns, const Kernel& kernel) {
  const DenormalsFlushed flushed;
  Rows rows;
  LearnerMeter meter(&state, kRounds * count);
  for (auto _ : state) {
    meter.Time([&] {
      for (int round = 0; round < kRounds; ++round) {
        kernel(rows);
        benchmark::ClobberMemory();
      }
    });
  }
  meter.ReportCyclesPerValue(kRounds * count * columns);
}

void NormaliseObservations(benchmark::State& state) {
  Pass(state, kRows, kObservationSize,
       [](Rows& rows) { NormaliseRows(kRows, kObservationSize, rows.a.data(), rows.b.data()); });
}

void ReluNormalise(benchmark::State& state) {
  Pass(state, kRows, kColumns, [](Rows& rows) {
    skein::ReluNormalise(kRows, kColumns, rows.a.data(), rows.inverse_std.data(),
                         rows.zero_level.data());
  });
}

void ReluNormaliseBackward(benchmark::State& state) {
  Pass(state, kRows, kColumns, [](Rows& rows) {
    skein::ReluNormaliseBackward(kRows, kColumns, rows.a.data(), rows.inverse_std.data(),
                                 rows.zero_level.data(), rows.b.data(), rows.sums.data());
  });
}

void NormaliseWithStd(benchmark::State& state) {
  Pass(state, kRows, kColumns, [](Rows& rows) {
    skein::NormaliseWithStd(kRows, kColumns, rows.a.data(), rows.b.data(), rows.inverse_std.data());
  });
}

void NormaliseBackward(benchmark::State& state) {
  Pass(state, kRows, kColumns, [](Rows& rows) {
    skein::NormaliseBackward(kRows, kColumns, rows.a.data(), rows.inverse_std.data(),
                             rows.b.data());
  });
}

void GruStep(benchmark::State& state) {
  Pass(state, kChunks, kColumns, [](Rows& rows) {
    skein::GruStep(kChunks, kColumns, rows.a.data(), rows.gates.data(), Rows::gate_stride,
                   rows.b.data());
  });
}

void GruStepBackward(benchmark::State& state) {
  Pass(state, kChunks, kColumns, [](Rows& rows) {
    const LaterStep later{rows.a.data(), rows.not_done.data()};
    skein::GruStepBackward(kChunks, kColumns, rows.a.data(), rows.gates.data(), Rows::gate_stride,
                           later, rows.b.data(), rows.sums.data());
  });
}

void AddColumnSums(benchmark::State& state) {
  Pass(state, kRows, kActionSize, [](Rows& rows) {
    skein::AddColumnSums(kRows, kActionSize, rows.a.data(), kActionSize, rows.sums.data());
  });
}

#define SKEIN_KERNEL(kernel) BENCHMARK(kernel)->UseManualTime()->MinTime(kMinSeconds)
SKEIN_KERNEL(NormaliseObservations);
SKEIN_KERNEL(ReluNormalise);
SKEIN_KERNEL(ReluNormaliseBackward);
SKEIN_KERNEL(NormaliseWithStd);
SKEIN_KERNEL(NormaliseBackward);
SKEIN_KERNEL(GruStep);
SKEIN_KERNEL(GruStepBackward);
SKEIN_KERNEL(AddColumnSums);
#undef SKEIN_KERNEL

}  // namespace
}  // namespace skein::bench
