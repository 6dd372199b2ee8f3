#pragma once

namespace skein::simd {

/// Measured float32 multiply-add rates, in GFLOP/s (a multiply-add counts as two).
struct PeakRate {
  double gflops_per_core = 0;  ///< one thread running alone
  double gflops = 0;           ///< all threads together
};

/// Measures what the multiply-add units give on the active target with operands in registers: the
/// roof that the rates of kernels are compared with. `threads` of them, at least 1. Takes about 0.2
/// s; best of several runs.
PeakRate MeasurePeak(int threads);

}  // namespace skein::simd
