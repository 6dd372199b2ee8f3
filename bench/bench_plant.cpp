// SPDX-License-Identifier: Apache-2.0
// The plant kernel: its parts one by one, whole evaluations, whole RK4 steps.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "base/denormals.h"
#include "base/worker_pool.h"
#include "bench/flock.h"
#include "bench/plant_parts.h"
#include "bench/report.h"

namespace skein::bench {
namespace {

constexpr float kDt = 0.02f;

void RunStagePart(benchmark::State& state, StagePart part) {
  constexpr int kRounds = 256;
  Flock flock(kPlantBlock);
  const DenormalsFlushed flushed;  // as on the environment's workers
  Meter meter(&state, static_cast<double>(kPlantBlock) * kRounds);
  for (auto _ : state) {
    meter.Time([&] { RunStagePart(part, KernelF16(), flock.At(0), kRounds); });
  }
  meter.Report();
}

/// Angles of flow, air, and where both lie in the tables.
void BM_AirData(benchmark::State& state) { RunStagePart(state, StagePart::kAirData); }
BENCHMARK(BM_AirData)->UseManualTime();

void BM_Engine(benchmark::State& state) { RunStagePart(state, StagePart::kEngine); }
BENCHMARK(BM_Engine)->UseManualTime();

void BM_AerodynamicsAndEquations(benchmark::State& state) {
  RunStagePart(state, StagePart::kAerodynamicsAndEquations);
}
BENCHMARK(BM_AerodynamicsAndEquations)->UseManualTime();

/// What a step reads of the tables, once.
void BM_ReadTables(benchmark::State& state) {
  Flock flock(1024);
  std::vector<std::vector<std::int32_t>> cell_slot, alpha_cell;
  for (int t = 0; t < flock.tiles(); ++t) {
    cell_slot.emplace_back(flock.At(t).stride);
    alpha_cell.emplace_back(flock.At(t).stride);
    FindTableCells(KernelF16(), flock.At(t), cell_slot.back().data(), alpha_cell.back().data());
  }
  Meter meter(&state, flock.count());
  for (auto _ : state) {
    meter.Time([&] {
      for (int t = 0; t < flock.tiles(); ++t) {
        const auto index = static_cast<std::size_t>(t);
        ReadTablesOf(KernelF16(), flock.At(t), cell_slot[index].data(), alpha_cell[index].data());
      }
    });
  }
  meter.Report();
}
BENCHMARK(BM_ReadTables)->UseManualTime();

/// One evaluation of the equations of motion with given thrust, tables read anew.
void BM_Evaluate(benchmark::State& state) {
  Flock flock(512);
  const std::size_t stride = flock.At(0).stride;
  const std::vector<float> thrust(stride, 5000);
  std::vector<float> rates(stride * kNumRigidBody), coefficients(stride * 6);
  const DenormalsFlushed flushed;
  Meter meter(&state, flock.count(), kFlopsPerEvaluation);
  for (auto _ : state) {
    meter.Time([&] {
      for (int t = 0; t < flock.tiles(); ++t) {
        const Tile tile = flock.At(t);
        const ControlColumns controls{thrust.data(), tile[kElevator], tile[kAileron], tile[kRudder],
                                      tile[kLeadingEdgeFlap]};
        EvaluateTile(KernelF16(), tile, controls, rates.data(), coefficients.data());
      }
    });
    benchmark::DoNotOptimize(rates.data());
  }
  meter.Report();
}
BENCHMARK(BM_Evaluate)->Unit(benchmark::kMicrosecond)->UseManualTime();

void BM_Rk4(benchmark::State& state) {
  constexpr int kStepsPerFlight = 100;
  Flock flock(static_cast<int>(state.range(0)));
  WorkerPool pool(static_cast<int>(state.range(1)));
  Meter meter(&state, flock.count(), kFlopsPerRk4Step, pool.threads());
  int step = 0;
  for (auto _ : state) {
    if (++step % kStepsPerFlight == 0) flock.Restart();
    meter.Time([&] {
      pool.ForEach(flock.tiles(), [&](int tile, int) {
        StepTile(KernelF16(), flock.At(tile), kDt, 1, flock.Behind(tile));
      });
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

}  // namespace
}  // namespace skein::bench
