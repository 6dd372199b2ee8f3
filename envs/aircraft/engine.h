// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/aircraft/aircraft.h"

namespace skein {

/// The engine's law of Stevens and Lewis, Aircraft Control and Simulation (after NASA TP-1538):
/// throttle commands power, power follows with a lag, tables turn it into thrust. Power is a number
/// from 0 (idle) over 50 (military) to 100 (maximum): the three levels of EngineTables.
inline constexpr double kMilitaryPower = 50;
inline constexpr double kMaximumPower = 100;

/// Commanded power for `throttle` in [0, 1] (clipped).
double PowerCommand(const ThrottleGearing& gearing, double throttle);

/// Throttle in [0, 1] that commands `power`; the inverse of PowerCommand.
double ThrottleForPower(const ThrottleGearing& gearing, double power);

/// Rate of change of power, 1/s, lagging towards `power_command`.
double PowerRate(const PowerLag& lag, double power, double power_command);

/// Installed thrust, lbf. Linear in power between idle and military and between military and
/// maximum; altitude and Mach number are clamped to the tables (the F-16's end at Mach 1), and
/// thrust is multiplied with the tables' growth if it grows. Idle thrust may be negative (the
/// F-16's ram drag at low altitude and high speed, a propeller's braking), as published.
double Thrust(const EngineTables& engine, double power, double altitude_ft, double mach);

/// Power in [0, 100] whose thrust comes nearest to `thrust_lbf`.
double PowerForThrust(const EngineTables& engine, double thrust_lbf, double altitude_ft,
                      double mach);

}  // namespace skein
