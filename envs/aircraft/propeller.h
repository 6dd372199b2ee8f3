// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/aircraft/aircraft.h"

namespace skein {

/// A fixed-pitch propeller on an electric motor (Beard and McLain, Small Unmanned Aircraft, the
/// supplement's propulsion model), in SI units. Thrust and torque coefficients are quadratic in the
/// advance ratio J = V / (n diameter): C = C_0 + C_1 J + C_2 J^2.
struct Propeller {
  double diameter_m = 0;
  double CT_0 = 0, CT_1 = 0, CT_2 = 0;
  double CQ_0 = 0, CQ_1 = 0, CQ_2 = 0;
  double speed_constant_rpm_per_V = 0;  ///< of the motor
  double resistance_ohm = 0;
  double no_load_current_A = 0;
  double max_voltage_V = 0;
};

/// Thrust, N, at the motor's speed for which its torque is the propeller's; `motor_throttle` in [0,
/// 1] is the fraction of the voltage. Negative where the air drives the propeller.
double PropellerThrust(const Propeller& propeller, double motor_throttle, double airspeed_m_s,
                       double density_kg_m3);

/// The motor throttles at idle, military and maximum power.
struct PropellerLevels {
  double idle = 0, military = 0, maximum = 1;
};

/// The widths of the cells of a table of thrust, three by ten, which begins at -2000 ft and Mach 0.
/// By default it ends at 13,000 ft and Mach 0.14.
struct PropellerCells {
  static constexpr int kAltitudes = 3, kMachs = 10;
  static constexpr double kLowestAltitude_ft = -2000;

  double altitude_ft = 5000;
  double mach = 0.014;
};

/// Thrust by altitude and Mach number in the U.S. Standard Atmosphere 1976. Exact at its nodes;
/// linear between them in altitude, Mach number and power.
EngineTables TabulatePropeller(const Propeller& propeller, const PropellerLevels& levels,
                               const PropellerCells& cells);

}  // namespace skein
