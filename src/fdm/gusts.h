// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "base/aligned_vector.h"
#include "envs/reference/plant.h"
#include "envs/state/state.h"
#include "envs/wind/dryden.h"

namespace skein {

/// Dryden turbulence (envs/wind/dryden.h) around one aircraft: the gusts that the environment would
/// draw with this seed for its first aircraft.
class Gusts {
 public:
  /// `standard_deviation_ft_s` is the vertical gust's, as `law` says.
  Gusts(double standard_deviation_ft_s, TurbulenceLaw law, std::uint64_t seed);

  /// The first gust around an aircraft in still air, north, east, down, ft/s.
  Eigen::Vector3d Start(const RigidBodyState& state);
  /// The gust `dt` seconds later. `velocity` is the aircraft's through the air, body axes.
  Eigen::Vector3d Advance(const RigidBodyState& state, const Eigen::Vector3d& velocity, double dt);

 private:
  Tile tile() { return {columns_.data(), stride_, 1, true}; }
  void SetState(const RigidBodyState& state);
  Eigen::Vector3d wind();

  TurbulenceLaw law_;
  std::uint64_t seed_;
  std::size_t stride_;
  AlignedVector<float> columns_;
  std::vector<std::int32_t> episode_, step_;  // of every lane
};

}  // namespace skein
