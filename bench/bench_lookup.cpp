// SPDX-License-Identifier: Apache-2.0
// The aerodynamic tables' functions for the four stages of a step, by arrangement of the tables.
// Every arrangement is checked against the plant kernel's before it is timed.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/denormals.h"
#include "bench/flock.h"
#include "bench/lookup_layouts.h"
#include "bench/lookup_tables.h"
#include "bench/report.h"
#include "envs/aircraft/table_lookup.h"

namespace skein::bench {
namespace {

// Aircraft whose places and readings fit the second-level cache beside the tables.
constexpr int kAircraft = 1024;
// Largest difference between two arrangements, relative to the largest value that is read: they
// round in different orders, float32.
constexpr double kAgreement = 2e-6;

/// Aircraft at the flight conditions of Flock; alpha and beta move a little from stage to stage and
/// stay in their cells.
std::vector<float> RandomPlaces(std::size_t stride) {
  const AerodynamicTables& tables = KernelF16().source.aerodynamics;
  std::vector<float> values(stride * kNumPlaceColumns);
  const Tile places{values.data(), stride, kAircraft};
  std::mt19937 random(1);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (std::size_t i = 0; i < stride; ++i) {
    const GridCell alpha = Locate(tables.alpha_deg, uniform(-3, 20));
    const GridCell beta = Locate(tables.beta_deg, uniform(-4, 4));
    const GridCell elevator = Locate(tables.elevator_deg, uniform(-5, 5));
    places[kPlaceAlphaCell][i] = static_cast<float>(alpha.index);
    places[kPlaceBetaCell][i] = static_cast<float>(beta.index);
    places[kPlaceElevatorCell][i] = static_cast<float>(elevator.index);
    places[kPlaceElevatorFraction][i] = static_cast<float>(elevator.fraction);
    places[kPlaceFlapUp][i] = static_cast<float>(uniform(0, 1));
    places[kPlaceAileron][i] = static_cast<float>(uniform(-0.25, 0.25));
    places[kPlaceRudder][i] = static_cast<float>(uniform(-0.2, 0.2));
    for (int stage = 0; stage < kStages; ++stage) {
      constexpr double kMove = 0.01;
      const auto moved = [&](double fraction) {
        return static_cast<float>(std::min(fraction + kMove * stage, 1.0));
      };
      places[kPlaceAlphaFraction + stage][i] = moved(alpha.fraction);
      places[kPlaceBetaFraction + stage][i] = moved(beta.fraction);
    }
  }
  return values;
}

/// The largest difference of a column, relative to its largest value, over all columns.
double Difference(const std::vector<float>& a, const std::vector<float>& b, std::size_t stride) {
  double worst = 0;
  for (int column = 0; column < kNumReadingColumns; ++column) {
    double largest = 0, difference = 0;
    for (std::size_t i = 0; i < kAircraft; ++i) {
      const std::size_t at = static_cast<std::size_t>(column) * stride + i;
      largest = std::max(largest, std::abs(static_cast<double>(a[at])));
      difference = std::max(difference, std::abs(static_cast<double>(a[at]) - b[at]));
    }
    worst = std::max(worst, difference / largest);
  }
  return worst;
}

void BM_Lookup(benchmark::State& state, LookupLayout layout) {
  const std::size_t stride = TileStride(kAircraft);
  std::vector<float> place_values = RandomPlaces(stride);
  const Tile places{place_values.data(), stride, kAircraft};
  const LookupTables tables = MakeLookupTables(KernelF16());
  const simd::DenormalsFlushed flushed;  // as on the environment's workers
  const auto read = [&](LookupLayout by, std::vector<float>* values) {
    ReadByLayout(by, KernelF16(), tables, places, {values->data(), stride, kAircraft});
  };
  std::vector<float> expected(stride * kNumReadingColumns), readings = expected;
  read(LookupLayout::kPatchesOnceAStep, &expected);
  read(layout, &readings);
  const double difference = Difference(expected, readings, stride);
  if (!(difference <= kAgreement)) {
    const std::string message =
        "differs from the plant kernel's reading by " + std::to_string(difference);
    state.SkipWithError(message.c_str());
    return;
  }
  Meter meter(&state, kAircraft, CostOf(layout));
  for (auto _ : state) {
    meter.Time([&] { read(layout, &readings); });
  }
  meter.Report();
}
BENCHMARK_CAPTURE(BM_Lookup, patches_once_a_step, LookupLayout::kPatchesOnceAStep)
    ->Unit(benchmark::kMicrosecond)
    ->UseManualTime();
BENCHMARK_CAPTURE(BM_Lookup, patches_every_stage, LookupLayout::kPatchesEveryStage)
    ->Unit(benchmark::kMicrosecond)
    ->UseManualTime();
BENCHMARK_CAPTURE(BM_Lookup, node_lines, LookupLayout::kNodeLines)
    ->Unit(benchmark::kMicrosecond)
    ->UseManualTime();
BENCHMARK_CAPTURE(BM_Lookup, gather_per_coefficient, LookupLayout::kGathers)
    ->Unit(benchmark::kMicrosecond)
    ->UseManualTime();

}  // namespace
}  // namespace skein::bench
