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

/// What Gusts are like.
struct GustSettings {
  double standard_deviation_ft_s = 0;  ///< the vertical gust's, as `law` says
  TurbulenceLaw law = TurbulenceLaw::kUniform;
  bool rotational = false;  ///< they turn, too
  std::uint64_t seed = 0;
};

/// How the air moves around an aircraft.
struct Gust {
  Eigen::Vector3d wind_ft_s;        ///< north, east, down
  Eigen::Vector3d air_rates_rad_s;  ///< body axes
};

/// Dryden turbulence (envs/wind/dryden.h) around one aircraft: gusts of the same statistics as the
/// environment's.
class Gusts {
 public:
  /// `span_ft` is the aircraft's.
  Gusts(const GustSettings& settings, double span_ft);

  /// The first gust around an aircraft in still air.
  Gust Start(const RigidBodyState& state);
  /// The gust `dt` seconds later. `velocity` is the aircraft's through the air, body axes.
  Gust Advance(const RigidBodyState& state, const Eigen::Vector3d& velocity, double dt);

 private:
  Tile tile() { return {columns_.data(), stride_, 1, true, rotational_}; }
  void SetState(const RigidBodyState& state);
  Gust Present();

  Turbulence turbulence_;
  bool rotational_;
  std::uint64_t seed_;
  std::size_t stride_;
  AlignedVector<float> columns_;
  std::vector<std::int32_t> episode_, step_;  // of every lane
};

}  // namespace skein
