// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "train/network/affine_map.h"
#include "train/network/network.h"

namespace skein {

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

/// Of the actor's and the critic's products. `precision` must not be kAuto.
NetworkPrecision ActorPrecision(LearnerPrecision precision);
NetworkPrecision CriticPrecision(LearnerPrecision precision);

/// One line for people: what computes the networks, how exactly, and why if not as asked.
std::string Describe(const BackendChoice& choice);

}  // namespace skein
