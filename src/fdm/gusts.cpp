// SPDX-License-Identifier: Apache-2.0
#include "src/fdm/gusts.h"

namespace skein {

Gusts::Gusts(double standard_deviation_ft_s, TurbulenceLaw law, std::uint64_t seed)
    : law_(law),
      seed_(seed),
      stride_(TileStride(1)),
      columns_(kNumWindyColumns * stride_),
      episode_(stride_),
      step_(stride_) {
  tile()[kTurbulenceStdDev][0] = static_cast<float>(standard_deviation_ft_s);
}

Eigen::Vector3d Gusts::Start(const RigidBodyState& state) {
  SetState(state);
  StartGusts(tile(), 0, {seed_, 0, episode_.data(), step_.data()}, law_);
  return wind();
}

Eigen::Vector3d Gusts::Advance(const RigidBodyState& state, const Eigen::Vector3d& velocity,
                               double dt) {
  SetState(state);
  for (int k = 0; k < 3; ++k) tile()[kAirU + k][0] = static_cast<float>(velocity[k]);
  ++step_[0];
  AdvanceGusts(tile(), static_cast<float>(dt), {seed_, 0, episode_.data(), step_.data()}, law_);
  return wind();
}

void Gusts::SetState(const RigidBodyState& state) {
  for (int column = 0; column < kNumRigidBody; ++column) {
    tile()[column][0] = static_cast<float>(state[column]);
  }
}

Eigen::Vector3d Gusts::wind() {
  return {tile()[kWindNorth][0], tile()[kWindEast][0], tile()[kWindDown][0]};
}

}  // namespace skein
