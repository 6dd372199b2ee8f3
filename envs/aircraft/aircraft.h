// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "envs/air/gravity.h"
#include "envs/aircraft/aerodynamic_tables.h"
#include "envs/aircraft/flight_control_gains.h"

namespace skein {

inline constexpr double kDegPerRad = 57.295779513082320877;

/// Mass, geometry and reference deflections. Foot, slug, second.
struct Airframe {
  double mass_slug = 0;
  double wing_area_ft2 = 0;
  double span_ft = 0;
  double chord_ft = 0;
  /// Centre of gravity as a fraction of the mean chord: where the tables' moments are taken, and
  /// where it is.
  double cg_reference = 0;
  double cg = 0;
  /// Moments and product of inertia, slug ft^2.
  double Ixx = 0, Iyy = 0, Izz = 0, Ixz = 0;
  /// Angular momentum of the engine about body x, slug ft^2/s; 0 leaves the gyroscopic terms out.
  double engine_angular_momentum = 0;
  /// Deflections, degrees, at which the tables' increments are taken.
  double aileron_reference_deg = 0, rudder_reference_deg = 0, leading_edge_flap_reference_deg = 0;
};

/// First-order actuator with rate and position limits: dx/dt = clip(bandwidth (clip(command) - x),
/// +-rate).
struct Actuator {
  double bandwidth_per_s = 0;
  double rate_limit_deg_per_s = 0;
  double min_deg = 0, max_deg = 0;
};

/// Of the four surfaces that move.
struct Actuators {
  Actuator elevator, aileron, rudder, leading_edge_flap;
};

/// A piecewise linear function of the Mach number between its nodes, constant outside. Without
/// nodes there is none.
struct MachFunction {
  std::vector<double> mach, value;
};

/// Thrust in lbf by [altitude][mach], row-major, at idle, military and maximum power; clamped
/// outside the axes.
struct EngineTables {
  std::vector<double> altitude_ft, mach;
  std::vector<double> idle_lbf, military_lbf, maximum_lbf;
  /// What thrust is multiplied with above Mach 1, if it grows there.
  MachFunction growth;
  bool grows = false;
};

/// Power that a throttle in [0, 1] commands: `dry_gain` throttle up to military_throttle,
/// afterburner_gain throttle + afterburner_offset above.
struct ThrottleGearing {
  double military_throttle = 0;
  double dry_gain = 0;
  double afterburner_gain = 0, afterburner_offset = 0;
};

/// The lag with which power follows its command. The rate of the lag falls with what is missing:
/// rate_offset_per_s - rate_slope_per_s (command - power), within the two limits. From
/// afterburner_power on a second stage burns, at a rate of its own; crossing it, power first heads
/// for a point on its own side. An engine of one stage has it at infinity.
struct PowerLag {
  double max_rate_per_s = 0, min_rate_per_s = 0;
  double rate_offset_per_s = 0, rate_slope_per_s = 0;
  double afterburner_power = std::numeric_limits<double>::infinity();
  double light_up_power = 0;  ///< first aim below afterburner_power when the command is above it
  double blow_out_power = 0;  ///< first aim above it when the command is below
  double afterburner_rate_per_s = 0;
};

/// What the tasks measure lengths and speeds by, in observations and rewards: the aircraft's own
/// scale, so that they are of order one and noise on them means the same to every aircraft.
struct ReferenceUnits {
  double altitude_error_ft = 0;  ///< errors of altitude
  double altitude_ft = 0;        ///< altitudes
  double speed_ft_s = 0;         ///< speeds and errors of speed
};

/// Everything that makes one aircraft, in double precision, as loaded from data/.
struct Aircraft {
  std::string name;
  Airframe airframe;
  AerodynamicTables aerodynamics;
  EngineTables engine;
  MachFunction drag_rise;  ///< coefficient of axial force (along -x) gained, if drag rises
  bool drag_rises = false;
  ThrottleGearing throttle_gearing;
  PowerLag power_lag;
  Actuators actuators;
  FlightControlGains flight_control;
  ReferenceUnits units;
  double untrimmed_thrust_lbf = 0;  ///< of starts that are not trimmed
};

}  // namespace skein
