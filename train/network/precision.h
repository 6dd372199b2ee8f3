// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simd/matrix_product.h"
#include "train/network/backend.h"

namespace skein {

/// Of the products in a network's forward and backward pass.
struct NetworkPrecision {
  simd::Precision forward = simd::Precision::kFloat32;
  simd::Precision backward = simd::Precision::kFloat32;
};

/// Of the actor's and the critic's products. `precision` must not be kAuto.
NetworkPrecision ActorPrecision(LearnerPrecision precision);
NetworkPrecision CriticPrecision(LearnerPrecision precision);

/// Of products whose peak a learner's rate is compared with: the fastest that all of its are at
/// most as exact as.
simd::Precision RoofPrecision(LearnerPrecision precision);

}  // namespace skein
