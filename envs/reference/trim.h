// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/reference/plant.h"

namespace skein {

/// The steady flight asked for.
struct TrimRequest {
  double altitude_ft = 0;
  double true_airspeed_ft_s = 0;
  double flight_path_angle_rad = 0;
  double turn_rate_rad_s = 0;  ///< + to the right; the trim is then a turn without sideslip
  /// + upwards: the rate at which pitch and flight path turn in the vertical plane. Speed and rates
  /// are steady then, flight path and attitude are not: a moment of a pull-up or, below zero, of a
  /// push-over.
  double pull_up_rate_rad_s = 0;
};

/// Steady flight, and the controls that keep it.
struct TrimPoint {
  RigidBodyState state;  ///< at north = east = 0, heading north
  Controls controls;     ///< leading-edge flap on its steady schedule
  /// Engine power (0..100) that gives controls.thrust_lbf, clipped to what the engine has.
  double power = 0;
  double alpha_rad = 0, bank_rad = 0, pitch_rad = 0;
  double residual = 0;  ///< largest remaining acceleration, ft/s^2 or rad/s^2
};

/// Solves for steady flight. Throws Error when it does not converge to a residual below 1e-6 or
/// when the solution needs deflections beyond the actuators' limits. Thrust beyond the engine's is
/// the caller's to check: it differs from that of `power` (Thrust in envs/aircraft/engine.h, which
/// has ThrottleForPower, too). Where a wing carries the weight below its stall and beyond
/// it, the flight below is the answer; beyond the stall only where there is none below, as where
/// thrust holds up what lift does not.
TrimPoint Trim(const Plant& plant, const TrimRequest& request);

/// The same, starting from the trim of a neighbouring condition. A start beyond the stall asks for
/// flight there.
TrimPoint Trim(const Plant& plant, const TrimRequest& request, const TrimPoint& start);

}  // namespace skein
