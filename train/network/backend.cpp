// SPDX-License-Identifier: Apache-2.0
#include "train/network/backend.h"

#include <utility>

#include "base/error.h"
#include "base/name_in.h"
#include "simd/target.h"
#include "train/network/network.h"

namespace skein {
namespace {

std::string DescribePrecision(LearnerPrecision precision) {
  if (precision == LearnerPrecision::kFloat32) return "in fp32";
  if (precision == LearnerPrecision::kAmx) {
    return std::string("in tiles of bf16, forward through the actor with two for each number") +
           (simd::NativeTiles() ? "" : ", emulated, slowly: this processor has no AMX");
  }
  std::string text = precision == LearnerPrecision::kFast
                         ? "the actor in mixed precision and the critic in bf16"
                         : std::string("in ") + Name(precision);
  return text + (simd::NativeBfloat16() ? "" : ", emulated: this processor has no bf16 products");
}

}  // namespace

const char* Name(Backend backend) { return NameIn(kBackendNames, backend); }
const char* Name(LearnerPrecision precision) { return NameIn(kPrecisionNames, precision); }

std::string FusedLimitation(const NetworkShape& shape) {
  if (shape.activation == Activation::kRelu) return "";
  return std::string("network.activation = \"") + Name(shape.activation) + "\"";
}

BackendChoice ChooseBackend(Backend asked, const NetworkShape& shape, LearnerPrecision precision) {
  BackendChoice choice;
  choice.backend = asked;
  choice.asked_precision = precision;
  if (asked == Backend::kFused) choice.fallback_reason = FusedLimitation(shape);
  if (!choice.fallback_reason.empty()) choice.backend = Backend::kLibTorch;
  if (choice.backend == Backend::kFused) {
    choice.precision = precision == LearnerPrecision::kAuto ? DefaultPrecision() : precision;
  }
  return choice;
}

LearnerPrecision DefaultPrecision() {
  if (simd::NativeTiles()) return LearnerPrecision::kAmx;
  return simd::FastBfloat16() ? LearnerPrecision::kFast : LearnerPrecision::kFloat32;
}

std::string Describe(const BackendChoice& choice) {
  if (choice.backend == Backend::kFused) {
    return "networks by the fused kernels, " + DescribePrecision(choice.precision);
  }
  std::string text =
      choice.fallback_reason.empty()
          ? "networks by LibTorch, as asked"
          : "networks by LibTorch, slower: the fused kernels do not know " + choice.fallback_reason;
  const LearnerPrecision asked = choice.asked_precision;
  if (asked != LearnerPrecision::kAuto && asked != choice.precision) {
    text +=
        std::string("; in fp32, not ") + Name(asked) + ": LibTorch computes in nothing else here";
  }
  return text;
}

}  // namespace skein
