// SPDX-License-Identifier: Apache-2.0
#include "train/network/precision.h"

#include <string>

#include "base/error.h"

namespace skein {
namespace {

NetworkPrecision ProductsOf(LearnerPrecision precision) {
  constexpr simd::Precision kFloat32 = simd::Precision::kFloat32;
  constexpr simd::Precision kBfloat16 = simd::Precision::kBfloat16;
  switch (precision) {
    case LearnerPrecision::kFloat32:
      return {kFloat32, kFloat32};
    case LearnerPrecision::kMixed:
      return {kFloat32, kBfloat16};
    case LearnerPrecision::kBfloat16:
      return {kBfloat16, kBfloat16};
    default:
      throw Error(std::string("precision \"") + Name(precision) + "\" is not one network's");
  }
}

}  // namespace

NetworkPrecision ActorPrecision(LearnerPrecision precision) {
  return ProductsOf(precision == LearnerPrecision::kFast ? LearnerPrecision::kMixed : precision);
}

NetworkPrecision CriticPrecision(LearnerPrecision precision) {
  return ProductsOf(precision == LearnerPrecision::kFast ? LearnerPrecision::kBfloat16 : precision);
}

}  // namespace skein
