// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simd/target.h"

// How to write a kernel: a .cpp file that is compiled once for every target of simd/target.h.
//
//   #include "envs/example_kernel.h"                      // its public header: no SIMD types
//
//   #include "simd/dispatch.h"
//
//   #undef HWY_TARGET_INCLUDE
//   #define HWY_TARGET_INCLUDE "envs/example_kernel.cpp"  // the file itself
//   #include <hwy/foreach_target.h>                       // re-includes it for every target
//   #include <hwy/highway.h>
//
//   #include "simd/math-inl.h"                            // vector mathematics, once per target
//   #include "simd/vocabulary-inl.h"                      // FloatTag, V, kLanes, Constant, hn
//
//   HWY_BEFORE_NAMESPACE();
//   namespace skein {
//   namespace HWY_NAMESPACE {
//   namespace {                                           // no clash with other kernels
//
//   void ScaleTile(float* x, int count, float factor) {   // the work of a whole tile
//     const FloatTag d;
//     for (int i = 0; i < count; i += kLanes) {           // 16, 8, 4 or 1
//       hn::StoreU(hn::Mul(hn::LoadU(d, x + i), Constant(factor)), d, x + i);
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
// and guarded by HWY_TARGET_TOGGLE as simd/math-inl.h is, instead of #pragma once. Other headers
// stand above HWY_TARGET_INCLUDE. Lambdas in kernels need HWY_ATTR. MulAdd is fused on avx512, avx2
// and neon and rounds twice on sse4 and scalar: targets agree to rounding; on one target results
// are bit-equal wherever a lane lies. Of a number and a NaN, Min and Max take the second operand on
// x86 but for scalar, and the number elsewhere.

/// The build of an HWY_EXPORTed function for the active target; throws Error if SKEIN_SIMD asks for
/// an unknown or unsupported one.
#define SKEIN_DISPATCH(function) \
  (static_cast<void>(::skein::simd::ActiveTarget()), HWY_DYNAMIC_DISPATCH(function))
