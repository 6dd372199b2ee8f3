// SPDX-License-Identifier: Apache-2.0
#include "bench/learner_meter.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <random>

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

double LearnerMeter::Median() {
  const auto middle = seconds_.begin() + static_cast<std::ptrdiff_t>(seconds_.size() / 2);
  std::nth_element(seconds_.begin(), middle, seconds_.end());
  return *middle;
}

void LearnerMeter::Report() {
  if (seconds_.empty()) return;
  // Plain numbers: benchmark::Counter's rates would print with a unit of their own.
  state_.counters["median_us"] = 1e6 * Median();
  if (samples_ > 0) state_.counters["samples/s"] = samples_ / Median();
  if (peak_seconds_ > 0) state_.counters["%_of_FMA_peak"] = 100 * peak_seconds_ / Median();
}

void LearnerMeter::ReportCyclesPerValue(std::int64_t values) {
  if (seconds_.empty()) return;
  static const double clock = simd::MeasureClock();
  Report();
  state_.counters["cycles/value"] = clock * Median() / static_cast<double>(values);
}

}  // namespace skein::bench
