// SPDX-License-Identifier: Apache-2.0
#include "src/fdm/gusts.h"

namespace skein {

Gusts::Gusts(const GustSettings& settings, double span_ft)
    : turbulence_{settings.law, span_ft},
      rotational_(settings.rotational),
      seed_(settings.seed),
      stride_(TileStride(1)),
      columns_(kNumRotationalGustColumns * stride_),
      episode_(stride_),
      step_(stride_) {
  tile()[kTurbulenceStdDev][0] = static_cast<float>(settings.standard_deviation_ft_s);
}

Gust Gusts::Start(const RigidBodyState& state) {
  SetState(state);
  StartGusts(tile(), 0, {seed_, 0, episode_.data(), step_.data()}, turbulence_);
  return Present();
}

Gust Gusts::Advance(const RigidBodyState& state, const Eigen::Vector3d& velocity, double dt) {
  SetState(state);
  for (int k = 0; k < 3; ++k) tile()[kAirU + k][0] = static_cast<float>(velocity[k]);
  ++step_[0];
  AdvanceGusts(tile(), static_cast<float>(dt), {seed_, 0, episode_.data(), step_.data()},
               turbulence_);
  return Present();
}

void Gusts::SetState(const RigidBodyState& state) {
  for (int column = 0; column < kNumRigidBody; ++column) {
    tile()[column][0] = static_cast<float>(state[column]);
  }
}

Gust Gusts::Present() {
  const auto vector = [&](int first) {
    return Eigen::Vector3d(tile()[first][0], tile()[first + 1][0], tile()[first + 2][0]);
  };
  return {vector(kWindNorth), vector(kGustRollRate)};
}

}  // namespace skein
