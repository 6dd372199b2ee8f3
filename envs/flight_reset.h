// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "envs/env_config.h"
#include "envs/reference/flight_control.h"
#include "envs/reference/plant.h"
#include "envs/reference/trim_table.h"
#include "envs/tasks/task.h"
#include "simd/random.h"

namespace skein {

/// A fresh flight: every physical column of one aircraft (envs/state/state.h), and what its
/// targets are drawn relative to.
struct FreshFlight {
  std::array<float, kNumColumns> columns{};
  FlightStart start;
};

/// Draws the states in which episodes begin. Heading north at the origin; flight control at rest.
class FlightReset {
 public:
  /// Solves the trims that trimmed starts need. Throws ChoiceError where there is none.
  FlightReset(const EnvConfig& config, const Aircraft& aircraft);

  /// From now on flights begin in the lowest and slowest `share`, in [0, 1], of the altitudes and
  /// airspeeds.
  void SetShare(double share) {
    altitude_ft_ = Lowest(initial_.drawn_altitude_ft(), share);
    true_airspeed_fps_ = Lowest(initial_.drawn_true_airspeed_fps(), share);
  }

  FreshFlight Draw(simd::RandomStream* random) const;

 private:
  TrimmedStart UntrimmedAt(double altitude_ft, double true_airspeed_ft_s) const;
  /// Turns a steady start into the middle of a pull-up of `pulled_g` more than that, by the slope
  /// of lift over alpha there: with the lift of the pitch rate the plant has up to 10 % of it more;
  /// beyond the alpha where lift is straight, in slow flight, it has less.
  void Pull(double pulled_g, RigidBodyState* state, TrimmedStart* start) const;

  InitialConfig initial_;
  Range altitude_ft_, true_airspeed_fps_;  ///< what is drawn from
  double load_factor_max_;
  Plant plant_;
  FlightControl flight_control_;
  int draw_power_;
  std::optional<TrimTable> trims_;
};

}  // namespace skein
