// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <benchmark/benchmark.h>

#include <vector>

#include "bench/seconds_of.h"

namespace skein::bench {

/// Times a benchmark that uses manual time, and reports aircraft per second, core cycles per
/// aircraft (of all threads together), and where operations were counted the percentage of the
/// measured multiply-add peak of as many threads: by the median of the calls, which other programs
/// disturb little. On the scalar target compilers make vectors of some loops by themselves, but not
/// of that which measures the peak: shares there may pass 100.
class Meter {
 public:
  /// Each call that is timed does its work for `aircraft` aircraft, with `flops` floating-point
  /// operations for each; 0 where they were not counted.
  Meter(benchmark::State* state, double aircraft, double flops = 0, int threads = 1);

  template <class Call>
  void Time(const Call& call) {
    const double seconds = SecondsOf(call);
    state_.SetIterationTime(seconds);
    seconds_.push_back(seconds);
  }

  /// After the last call.
  void Report();

 private:
  benchmark::State& state_;
  double aircraft_;
  double flops_;
  int threads_;
  std::vector<double> seconds_;  // of each call
};

/// Puts the program's commit (as in BuildInfo, src/bench/version.h), its SIMD target and the
/// machine's roofs, for one thread, at the head of the report: in JSON under "context".
void DescribeContext();

}  // namespace skein::bench
