// SPDX-License-Identifier: Apache-2.0
#include "bench/learner_meter.h"

#include <map>
#include <random>

#include "base/median.h"
#include "simd/peak.h"

namespace skein::bench {

AlignedVector<float> Normal(std::int64_t count, float scale) {
  static std::mt19937 generator(1);
  std::normal_distribution<float> normal(0, scale);
  AlignedVector<float> values(count);
  for (float& value : values) value = normal(generator);
  return values;
}

double Peak(simd::Precision precision) {
  static std::map<simd::Precision, double> measured;
  double& peak = measured[precision];
  if (peak == 0) peak = 1e9 * simd::MeasureProductPeak(precision, 1).gflops_per_core;
  return peak;
}

void LearnerMeter::Report() {
  if (seconds_.empty()) return;
  const double median = Median(seconds_);
  // Plain numbers: benchmark::Counter's rates would print with a unit of their own.
  state_.counters["median_us"] = 1e6 * median;
  if (samples_ > 0) state_.counters["samples/s"] = samples_ / median;
  if (peak_seconds_ > 0) state_.counters["%_of_FMA_peak"] = 100 * peak_seconds_ / median;
}

void LearnerMeter::ReportCyclesPerValue(std::int64_t values) {
  if (seconds_.empty()) return;
  static const double clock = simd::MeasureClock();
  Report();
  state_.counters["cycles/value"] = clock * Median(seconds_) / static_cast<double>(values);
}

}  // namespace skein::bench
