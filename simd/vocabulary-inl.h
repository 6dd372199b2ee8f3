// SPDX-License-Identifier: Apache-2.0
// The words that kernels are written in (see simd/dispatch.h): the widest float32 vectors of the
// target, and the integers and truths of as many lanes.

#if defined(SKEIN_SIMD_VOCABULARY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKEIN_SIMD_VOCABULARY_INL_H_
#undef SKEIN_SIMD_VOCABULARY_INL_H_
#else
#define SKEIN_SIMD_VOCABULARY_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace skein {
namespace HWY_NAMESPACE {

// A test puts operations that count themselves in the place of Highway's.
#ifndef SKEIN_HIGHWAY
#define SKEIN_HIGHWAY hwy::HWY_NAMESPACE
#endif
namespace hn = SKEIN_HIGHWAY;

using FloatTag = hn::ScalableTag<float>;
using IntTag = hn::RebindToSigned<FloatTag>;
using UintTag = hn::RebindToUnsigned<FloatTag>;
using V = hn::Vec<FloatTag>;
using VI = hn::Vec<IntTag>;
using Mask = hn::Mask<FloatTag>;

/// 16, 8, 4 or 1.
inline constexpr int kLanes = static_cast<int>(hn::MaxLanes(FloatTag()));

/// The float32 nearest to `value` in every lane.
template <typename T>
HWY_INLINE V Constant(T value) {
  return hn::Set(FloatTag(), static_cast<float>(value));
}

}  // namespace HWY_NAMESPACE
}  // namespace skein
HWY_AFTER_NAMESPACE();

#endif  // SKEIN_SIMD_VOCABULARY_INL_H_
