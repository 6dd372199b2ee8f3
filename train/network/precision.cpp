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
    case LearnerPrecision::kAmx:
      return {simd::Precision::kTiles, simd::Precision::kTiles};
    default:
      throw Error(std::string("precision \"") + Name(precision) + "\" is not one network's");
  }
}

}  // namespace

NetworkPrecision ActorPrecision(LearnerPrecision precision) {
  if (precision == LearnerPrecision::kFast) return ProductsOf(LearnerPrecision::kMixed);
  NetworkPrecision products = ProductsOf(precision);
  if (precision == LearnerPrecision::kAmx) products.forward = simd::Precision::kSplitTiles;
  return products;
}

NetworkPrecision CriticPrecision(LearnerPrecision precision) {
  return ProductsOf(precision == LearnerPrecision::kFast ? LearnerPrecision::kBfloat16 : precision);
}

simd::Precision RoofPrecision(LearnerPrecision precision) {
  if (precision == LearnerPrecision::kBfloat16) return simd::Precision::kBfloat16;
  return precision == LearnerPrecision::kAmx ? simd::Precision::kTiles : simd::Precision::kFloat32;
}

}  // namespace skein
