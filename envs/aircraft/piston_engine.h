// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "envs/aircraft/aircraft.h"

namespace skein {

/// How a propeller is described, and what its thrust is.
enum class PropellerModel {
  /// CT rho n^2 diameter^4 at the speed n where it takes, CP rho n^3 diameter^5, what the engine
  /// gives.
  kFixedPitch,
  /// A governor keeps the rated speed: efficiency power / V.
  kConstantSpeed,
  /// A straight propeller polar, CT / J^2 = slope CP / J^2 + intercept, as fixed-pitch propellers
  /// have: with a torque Q it is slope 2 pi Q / diameter + intercept rho V^2 diameter^2, whatever
  /// the speed n (J. T. Lowry, Performance of Light Aircraft, AIAA, 1999).
  kPolar,
};

/// A piston engine and its propeller, in SI units. Its torque is that of its rated power at its
/// rated speed, times the throttle, times what altitude leaves of it, whatever the speed.
struct PistonEngine {
  double rated_power_W = 0;
  double rated_rpm = 0;
  /// Fraction of the rated power left by altitude, held outside. Without nodes: the law of Gagg and
  /// Ferrar (SAE, 1934), 1.132 sigma - 0.132, sigma the density over that at sea level.
  std::vector<double> altitude_m, power_fraction;

  PropellerModel propeller = PropellerModel::kFixedPitch;
  double diameter_m = 0;  ///< of the propeller
  /// By advance ratio J = V / (n diameter), n in revolutions per second; linear between nodes, held
  /// outside.
  std::vector<double> advance_ratio;
  std::vector<double> efficiency;  ///< constant speed; zero at J = 0
  std::vector<double> CT, CP;      ///< fixed pitch
  double polar_slope = 0, polar_intercept = 0;
};

/// The throttle, a fraction of the torque, at idle, military and maximum power.
struct ThrottleLevels {
  double idle = 0, military = 0, maximum = 1;
};

/// Where tables of thrust end.
struct ThrustRange {
  double altitude_ft = 0;
  double mach = 0;
};

/// Fraction of the rated power that the engine has at `altitude_ft` of the U.S. Standard
/// Atmosphere 1976.
double PowerFraction(const PistonEngine& engine, double altitude_ft);

/// Thrust, N, at `altitude_ft` of that atmosphere. Negative where the air drives the propeller.
double PistonThrust(const PistonEngine& engine, double throttle, double airspeed_m_s,
                    double altitude_ft);

/// Thrust by altitude and Mach number, from -2000 ft and 0 to the ends of `range`, at 4 x 9 nodes.
EngineTables TabulatePiston(const PistonEngine& engine, const ThrottleLevels& levels,
                            const ThrustRange& range);

}  // namespace skein
