#pragma once

#include <string>
#include <vector>

#include "envs/aircraft/aerodynamic_tables.h"
#include "envs/aircraft/flight_control_gains.h"

namespace skein {

/// Gravity of the published F-16 models, ft/s^2.
inline constexpr double kGravityFtS2 = 32.17;

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

/// Everything that makes one aircraft, in double precision, as loaded from data/.
struct Aircraft {
  std::string name;
  Airframe airframe;
  AerodynamicTables aerodynamics;
  EngineTables engine;
  MachFunction drag_rise;  ///< coefficient of axial force (along -x) gained, if drag rises
  bool drag_rises = false;
  Actuators actuators;
  FlightControlGains flight_control;
};

}  // namespace skein
