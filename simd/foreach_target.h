#pragma once

// How to write a kernel: a .cpp file that is compiled once for every target of simd/target.h.
//
//   #include "envs/example_kernel.h"                        // its public header: no SIMD types
//
//   #undef HWY_TARGET_INCLUDE
//   #define HWY_TARGET_INCLUDE "envs/example_kernel.cpp"    // the file itself
//   #include "simd/foreach_target.h"                        // before any other header of Highway
//   #include "hwy/highway.h"
//   #include "simd/math-inl.h"                              // included once per target
//
//   HWY_BEFORE_NAMESPACE();
//   namespace skein {
//   namespace HWY_NAMESPACE {
//   namespace {                                             // no clash with other kernels
//   namespace hn = hwy::HWY_NAMESPACE;
//
//   void ScaleTile(float* x, int count, float factor) {     // the work of a whole tile
//     const hn::ScalableTag<float> d;                       // 16, 8, 4 or 1 lanes
//     const int lanes = static_cast<int>(hn::Lanes(d));
//     for (int i = 0; i < count; i += lanes) {
//       hn::StoreU(hn::Mul(hn::LoadU(d, x + i), hn::Set(d, factor)), d, x + i);
//     }
//   }
//
//   }  // namespace
//   }  // namespace HWY_NAMESPACE
//   }  // namespace skein
//   HWY_AFTER_NAMESPACE();
//
//   #if HWY_ONCE
//   namespace skein {
//   HWY_EXPORT(ScaleTile);
//   void Scale(float* x, int count, float factor) { SKEIN_DISPATCH(ScaleTile)(x, count, factor); }
//   }  // namespace skein
//   #endif
//
// Rules: dispatch once, at the top of a tile's work. A header shared by kernels is named *-inl.h
// and guarded by the toggle of simd/math-inl.h instead of #pragma once. Lambdas in kernels need
// HWY_ATTR. Headers of the standard library and of Skein that a kernel needs are included above
// foreach_target.h or have #pragma once. MulAdd is fused on avx512 and avx2, and rounds twice on
// sse4 and scalar: results agree between targets to rounding, and are bit-equal on one target.

#include "simd/highway_targets.h"
#include "simd/target.h"
// Re-includes HWY_TARGET_INCLUDE for every target.
#include "hwy/foreach_target.h"

/// The build of an HWY_EXPORTed function for the active target; throws Error if SKEIN_SIMD asks for
/// an unknown or unsupported one.
#define SKEIN_DISPATCH(function) \
  (static_cast<void>(::skein::simd::ActiveTarget()), HWY_DYNAMIC_DISPATCH(function))
