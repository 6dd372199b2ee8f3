// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "envs/reference/plant.h"

namespace skein {

/// d(state_rate) = A d(state) + B d(controls), controls in the order thrust [lbf], elevator,
/// aileron, rudder, leading-edge flap [deg].
struct LinearModel {
  Eigen::Matrix<double, 13, 13> A;
  Eigen::Matrix<double, 13, 5> B;
};

/// Central differences about a point. The tables have kinks at their nodes: steps of 1e-4 of each
/// variable's natural size keep to one cell unless the point lies on a node.
LinearModel Linearise(const Plant& plant, const RigidBodyState& state, const Controls& controls);

}  // namespace skein
