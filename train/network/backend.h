// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <utility>

namespace skein {

struct NetworkShape;  // train/network/network.h

/// What computes the networks, forward and backward.
enum class Backend {
  kFused,     ///< custom kernels, tile by tile
  kLibTorch,  ///< LibTorch's operations and autograd: the reference, two to three times slower
};

/// Names in configurations and files.
inline constexpr std::array<std::pair<Backend, const char*>, 2> kBackendNames{
    {{Backend::kFused, "fused"}, {Backend::kLibTorch, "libtorch"}}};
const char* Name(Backend backend);

/// Of the operands of a network's products; sums and all the rest are float32.
enum class LearnerPrecision {
  /// kAmx where the processor multiplies tiles, else kFast where it multiplies bfloat16 faster than
  /// float32, else kFloat32.
  kAuto,
  kFloat32,
  kMixed,     ///< forward float32, backward bfloat16
  kBfloat16,  ///< both bfloat16
  kFast,      ///< actor kMixed, critic kBfloat16
  kAmx,       ///< tiles of bfloat16, the actor's forward pass with operands of two each
};

/// Names in configurations and files.
inline constexpr std::array<std::pair<LearnerPrecision, const char*>, 6> kPrecisionNames{
    {{LearnerPrecision::kAuto, "auto"},
     {LearnerPrecision::kFloat32, "fp32"},
     {LearnerPrecision::kMixed, "mixed"},
     {LearnerPrecision::kBfloat16, "bf16"},
     {LearnerPrecision::kFast, "fast"},
     {LearnerPrecision::kAmx, "amx"}}};
const char* Name(LearnerPrecision precision);

/// What computes a network, and why, if it is not what was asked for.
struct BackendChoice {
  Backend backend = Backend::kFused;
  std::string fallback_reason;  ///< what the fused kernels cannot do; empty if nothing
  LearnerPrecision precision = LearnerPrecision::kFloat32;  ///< never kAuto
  LearnerPrecision asked_precision = LearnerPrecision::kFloat32;
};

/// What of `shape` the fused kernels cannot compute, as key and value; empty if they can.
std::string FusedLimitation(const NetworkShape& shape);

/// The backend that was asked for, or LibTorch where the fused kernels cannot compute the shape.
/// LibTorch computes in float32 alone.
BackendChoice ChooseBackend(Backend asked, const NetworkShape& shape,
                            LearnerPrecision precision = LearnerPrecision::kFloat32);

/// What kAuto is on this machine.
LearnerPrecision DefaultPrecision();

/// One line for people: what computes the networks, how exactly, and why if not as asked.
std::string Describe(const BackendChoice& choice);

}  // namespace skein
