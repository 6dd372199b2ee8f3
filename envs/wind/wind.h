// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "envs/wind/dryden.h"
#include "envs/wind/wind_config.h"

namespace skein {

/// The wind of an environment's episodes: for each a steady wind and turbulence drawn from the
/// configured ranges.
class Wind {
 public:
  /// Speeds and turbulence are drawn with BentInto's `power`. `span_ft` is the aircraft's.
  Wind(const WindConfig& config, int draw_power, double span_ft)
      : config_(config), drawn_(config), draw_power_(draw_power), span_ft_(span_ft) {
    SetShare(1);
  }

  /// From now on winds and turbulence are drawn from the weakest `share`, in [0, 1], of their
  /// ranges.
  void SetShare(double share) {
    drawn_.speed_fps = Lowest(config_.drawn_speed_fps(), share);
    drawn_.turbulence_fps = Lowest(config_.drawn_turbulence_fps(), share);
  }

  /// Whether tiles must be windy; rotational gusts are there if WindConfig has them.
  bool enabled() const { return config_.enabled(); }

  /// Draws the wind of an episode of aircraft `index`, whose flight in still air the tile holds,
  /// and sets its wind columns. Unless the wind is a step at reset, the aircraft's velocity over
  /// ground becomes that with which it flies in the steady wind as it did in still air.
  void Begin(Tile tile, int index, const GustKeys& keys) const;

  /// The wind of the next control step, `dt` seconds long.
  void Advance(Tile tile, float dt, const GustKeys& keys) const {
    if (config_.drawn_turbulence_fps().max > 0) AdvanceGusts(tile, dt, keys, law());
  }

 private:
  Turbulence law() const {
    return {config_.turbulence_by_altitude ? TurbulenceLaw::kByAltitude : TurbulenceLaw::kUniform,
            span_ft_};
  }

  WindConfig config_;
  WindConfig drawn_;  ///< what the next episodes are drawn from
  int draw_power_;
  double span_ft_;
};

}  // namespace skein
