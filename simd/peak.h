// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simd/matrix_product.h"

// Roofs that the rates of kernels are compared with, measured on this machine for the active
// target. A figure takes some 0.1 s, and is the best of many short runs unless it says otherwise;
// functions of `threads` throw Error for fewer than 1.

namespace skein::simd {

/// Measured multiply-add rates, in GFLOP/s (a multiply-add counts as two).
struct PeakRate {
  double gflops_per_core = 0;  ///< one thread running alone
  double gflops = 0;           ///< all threads together
  /// All threads, none waiting for another, the median of the runs: what other programs and virtual
  /// machines leave, to compare with the median of a long computation that is measured in turns.
  double median_gflops = 0;
};

/// Measures what the multiply-add units give with operands in registers; where four begin one in a
/// cycle (some of AArch64) three quarters of it.
PeakRate MeasurePeak(int threads);

/// The same of the instruction that products of this precision take (simd/matrix_product.h):
/// MeasurePeak where the processor has none but multiply-adds. Of kSplitTiles' three products one
/// counts.
PeakRate MeasureProductPeak(Precision precision, int threads);

/// The clock of one core at work on vectors, cycles/s: a chain of dependent 64-bit multiplications,
/// of three cycles each on x86 processors since 2008 (Intel) and 2017 (AMD), beside multiply-adds.
/// Not the time-stamp counter's rate, which does not follow the clock.
double MeasureClock();

}  // namespace skein::simd
