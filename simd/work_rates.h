// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace skein::simd {

/// Does `rounds` rounds of some work and returns how much that is; `sink` gets a result, so that
/// the work cannot be left out.
using Work = double (*)(std::int64_t rounds, float* sink);

/// Rates of several repetitions in which all threads start together, work per second, in ascending
/// order.
struct WorkRates {
  std::vector<double> of_slowest;  ///< all work in the slowest thread's time
  std::vector<double> summed;      ///< of each thread's own rate: as if none waited for another
};

/// Of the work that `threads` threads have done and the seconds that they took, both
/// [repetition][thread].
WorkRates RatesOf(const std::vector<double>& done, const std::vector<double>& seconds, int threads);

/// Lets `threads` threads, of which the caller's is one, do `work` so many times.
WorkRates MeasureRates(Work work, std::int64_t rounds, int repetitions, int threads);

}  // namespace skein::simd
