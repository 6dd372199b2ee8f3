// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/engine.h"

#include <algorithm>

#include "envs/aircraft/table_lookup.h"

namespace skein {
namespace {

// The three thrust levels at one flight condition, lbf.
struct ThrustLevels {
  double idle, military, maximum;
};

ThrustLevels LevelsAt(const EngineTables& engine, double altitude_ft, double mach) {
  const GridCell altitude = Locate(engine.altitude_ft, altitude_ft);
  const GridCell column = Locate(engine.mach, mach);
  const int columns = static_cast<int>(engine.mach.size());
  const double growth = engine.grows ? ValueAt(engine.growth, mach) : 1;
  return {growth * Interpolate(engine.idle_lbf, altitude, column, columns),
          growth * Interpolate(engine.military_lbf, altitude, column, columns),
          growth * Interpolate(engine.maximum_lbf, altitude, column, columns)};
}

// Reciprocal time constant of the power lag, 1/s, by the distance still to go.
double LagRate(const PowerLag& lag, double distance) {
  return std::clamp(lag.rate_offset_per_s - lag.rate_slope_per_s * distance, lag.min_rate_per_s,
                    lag.max_rate_per_s);
}

}  // namespace

double PowerCommand(const ThrottleGearing& gearing, double throttle) {
  throttle = std::clamp(throttle, 0.0, 1.0);
  return throttle <= gearing.military_throttle
             ? gearing.dry_gain * throttle
             : gearing.afterburner_gain * throttle + gearing.afterburner_offset;
}

double ThrottleForPower(const ThrottleGearing& gearing, double power) {
  const double dry = power / gearing.dry_gain;
  const double throttle = dry <= gearing.military_throttle
                              ? dry
                              : (power - gearing.afterburner_offset) / gearing.afterburner_gain;
  return std::clamp(throttle, 0.0, 1.0);
}

double PowerRate(const PowerLag& lag, double power, double power_command) {
  // Crossing to or from the second stage, the engine first heads for a point on its own side of the
  // gap; only then for the command.
  const bool is_asked = power_command >= lag.afterburner_power;
  if (power >= lag.afterburner_power) {
    const double target = is_asked ? power_command : lag.blow_out_power;
    return lag.afterburner_rate_per_s * (target - power);
  }
  const double target = is_asked ? lag.light_up_power : power_command;
  return LagRate(lag, target - power) * (target - power);
}

double Thrust(const EngineTables& engine, double power, double altitude_ft, double mach) {
  const ThrustLevels level = LevelsAt(engine, altitude_ft, mach);
  if (power < kMilitaryPower) {
    return level.idle + (level.military - level.idle) * power / kMilitaryPower;
  }
  return level.military + (level.maximum - level.military) * (power - kMilitaryPower) /
                              (kMaximumPower - kMilitaryPower);
}

double PowerForThrust(const EngineTables& engine, double thrust_lbf, double altitude_ft,
                      double mach) {
  const ThrustLevels level = LevelsAt(engine, altitude_ft, mach);
  // High and slow, the tables' idle thrust exceeds their military thrust: thrust need not rise with
  // power.
  const double dry = (thrust_lbf - level.idle) / (level.military - level.idle);
  if (dry >= 0 && dry <= 1) return kMilitaryPower * dry;
  const double afterburner = (thrust_lbf - level.military) / (level.maximum - level.military);
  if (afterburner > 0) {
    return kMilitaryPower + (kMaximumPower - kMilitaryPower) * std::min(afterburner, 1.0);
  }
  return level.idle < level.military ? 0 : kMilitaryPower;
}

}  // namespace skein
