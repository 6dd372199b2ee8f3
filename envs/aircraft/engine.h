#pragma once

#include "envs/aircraft/aircraft.h"

namespace skein {

/// Engine of Stevens and Lewis, Aircraft Control and Simulation (after NASA TP-1538). Power is a
/// number from 0 (idle) over 50 (military) to 100 (maximum, full afterburner).

/// Throttle gearing: `dry_gain` throttle up to military, afterburner_gain throttle +
/// afterburner_offset above.
struct ThrottleGearing {
  double military_throttle = 0.77;
  double dry_gain = 64.94;
  double afterburner_gain = 217.38;
  double afterburner_offset = -117.38;
};
inline constexpr ThrottleGearing kThrottleGearing{};

/// Levels of power, and the lag with which power follows its command: up to 1/s while 25 or less is
/// missing, falling to min_rate_per_s at 50.
struct PowerLag {
  double military_power = 50;
  double maximum_power = 100;
  double light_up_power = 60;  ///< first aim below military power when the command is above it
  double blow_out_power = 40;  ///< first aim above military power when the command is below it
  double afterburner_rate_per_s = 5;
  double max_rate_per_s = 1, min_rate_per_s = 0.1;
  /// Between the two, the rate is rate_offset_per_s - rate_slope_per_s * (what is missing).
  double rate_offset_per_s = 1.9, rate_slope_per_s = 0.036;
};
inline constexpr PowerLag kPowerLag{};

/// Commanded power for `throttle` in [0, 1] (clipped): military at 0.77, afterburner above.
double PowerCommand(double throttle);

/// Throttle in [0, 1] that commands `power`; the inverse of PowerCommand.
double ThrottleForPower(double power);

/// Rate of change of power, 1/s, lagging towards `power_command`.
double PowerRate(double power, double power_command);

/// Installed thrust, lbf. Linear in power between idle and military and between military and
/// maximum; altitude and Mach number are clamped to the tables (no data above Mach 1), and
/// thrust is multiplied with the tables' growth if it grows. Idle thrust is negative at low
/// altitude and high speed (ram drag), as published.
double Thrust(const EngineTables& engine, double power, double altitude_ft, double mach);

/// Power in [0, 100] whose thrust comes nearest to `thrust_lbf`.
double PowerForThrust(const EngineTables& engine, double thrust_lbf, double altitude_ft,
                      double mach);

}  // namespace skein
