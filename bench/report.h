// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <benchmark/benchmark.h>

#include <chrono>
#include <vector>

namespace skein::bench {

/// What a part of the simulator does for one aircraft, counted in its source. Floating-point
/// operations: a multiply-add is two; an addition, product, minimum, division, root or estimate of
/// one is one; comparisons, selections, conversions and operations on integers are none. Bytes
/// loaded: from columns, scratch memory and tables, as on avx512 (a lookup of 32 entries in
/// registers loads two vectors for sixteen aircraft); not constants and spilled registers. 0 where
/// nobody counted.
struct Cost {
  double flops = 0;
  double bytes_loaded = 0;
};

/// Times a benchmark that uses manual time, and reports aircraft per second, core cycles per
/// aircraft (of all threads together), and the percentages of the measured multiply-add and load
/// peaks of as many threads: by the median of the calls, which other programs disturb little. On
/// the scalar target compilers make vectors of some loops by themselves, but not of those that
/// measure the peaks: shares there may pass 100.
class Meter {
 public:
  /// Each call that is timed does its work for `aircraft` aircraft.
  Meter(benchmark::State* state, double aircraft, const Cost& cost, int threads = 1);

  template <class Call>
  void Time(const Call& call) {
    const auto start = Clock::now();
    call();
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    state_.SetIterationTime(seconds);
    seconds_.push_back(seconds);
  }

  /// After the last call.
  void Report();

 private:
  using Clock = std::chrono::steady_clock;

  benchmark::State& state_;
  double aircraft_;
  Cost cost_;
  int threads_;
  std::vector<double> seconds_;  // of each call
};

/// Puts the machine's roofs, for one thread, at the head of the report.
void DescribeRoofs();

}  // namespace skein::bench
