#pragma once

// Which of Highway's targets Skein's kernels are built for: AVX3 (AVX-512 as in Skylake servers),
// AVX2, SSE4 and SCALAR. To be seen before any header of Highway.

#ifdef HIGHWAY_HWY_DETECT_TARGETS_H_
#error "include simd/highway_targets.h (or simd/foreach_target.h) before Highway's own headers"
#endif

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)

// SCALAR, not EMU128, on every compiler: g++ 12.2 miscompiles EMU128 (GCC bug 106322).
#define HWY_BROKEN_EMU128 1
