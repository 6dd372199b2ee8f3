// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "base/aligned_vector.h"
#include "bench/seconds_of.h"
#include "simd/matrix_product.h"

namespace skein::bench {

/// Gaussian values of zero mean, others at every call.
AlignedVector<float> Normal(std::int64_t count, float scale = 1);

/// The roof of one core's products, FLOP/s, measured once; bfloat16 has that of float32 where the
/// processor has no instruction for it.
double Peak(simd::Precision precision);

/// Times a part of the learner by the benchmark's manual time, and reports by the median of the
/// calls, which other programs disturb little.
class LearnerMeter {
 public:
  /// Each call that is timed does its work for `samples` samples; at the measured peak its products
  /// would take `peak_seconds`, 0 where there are none to speak of.
  LearnerMeter(benchmark::State* state, std::int64_t samples, double peak_seconds = 0)
      : state_(*state), samples_(static_cast<double>(samples)), peak_seconds_(peak_seconds) {}

  template <class Call>
  void Time(const Call& call) {
    const double seconds = SecondsOf(call);
    state_.SetIterationTime(seconds);
    seconds_.push_back(seconds);
  }

  /// After the last call: samples/s, and the percentage of the peak.
  void Report();
  /// The same for a pass over `values` values a call: core cycles per value, too.
  void ReportCyclesPerValue(std::int64_t values);

 private:
  benchmark::State& state_;
  double samples_, peak_seconds_;
  std::vector<double> seconds_;  // of each call
};

}  // namespace skein::bench
