// SPDX-License-Identifier: Apache-2.0
#include "bench/report.h"

#include <cstdio>
#include <map>
#include <string>

#include "base/median.h"
#include "simd/peak.h"
#include "simd/target.h"

namespace skein {

// Of the generated commit.cpp (cmake/Commit.cmake).
extern const char* const kCommit;

namespace bench {
namespace {

struct Roofs {
  simd::PeakRate peak;
  double clock = 0;  // cycles/s
};

const Roofs& MeasuredRoofs(int threads) {
  static std::map<int, Roofs> measured;
  const auto found = measured.find(threads);
  if (found != measured.end()) return found->second;
  return measured[threads] = {simd::MeasurePeak(threads), simd::MeasureClock()};
}

std::string Rounded(double value, const char* unit) {
  char text[64];
  std::snprintf(text, sizeof text, "%.2f %s", value, unit);
  return text;
}

}  // namespace

Meter::Meter(benchmark::State* state, double aircraft, double flops, int threads)
    : state_(*state), aircraft_(aircraft), flops_(flops), threads_(threads) {}

void Meter::Report() {
  if (seconds_.empty()) return;
  const Roofs& roofs = MeasuredRoofs(threads_);
  const double rate = aircraft_ / Median(seconds_);
  // Plain numbers: benchmark::Counter's rates would print with a unit of their own.
  state_.counters["aircraft/s"] = rate;
  state_.counters["cycles/aircraft"] = threads_ * roofs.clock / rate;
  if (flops_ > 0) {
    state_.counters["%_of_FMA_peak"] = 100 * rate * flops_ / (roofs.peak.gflops * 1e9);
  }
}

void DescribeContext() {
  const Roofs& roofs = MeasuredRoofs(1);
  benchmark::AddCustomContext("commit", kCommit);
  benchmark::AddCustomContext("simd_target", simd::Name(simd::ActiveTarget()));
  benchmark::AddCustomContext("core_clock", Rounded(roofs.clock / 1e9, "GHz"));
  benchmark::AddCustomContext("core_fma_peak", Rounded(roofs.peak.gflops_per_core, "GFLOP/s"));
  const auto add_peak = [](const char* name, simd::Precision precision) {
    const double peak = simd::MeasureProductPeak(precision, 1).gflops_per_core;
    benchmark::AddCustomContext(name, Rounded(peak, "GFLOP/s"));
  };
  if (simd::NativeBfloat16()) add_peak("core_bfloat16_peak", simd::Precision::kBfloat16);
  if (simd::NativeTiles()) add_peak("core_tile_peak", simd::Precision::kTiles);
}

}  // namespace bench
}  // namespace skein
