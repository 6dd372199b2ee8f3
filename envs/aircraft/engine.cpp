#include "envs/aircraft/engine.h"

#include <algorithm>

#include "envs/aircraft/table_lookup.h"

namespace skein {
namespace {

constexpr double kMilitaryPower = kPowerLag.military_power;
constexpr double kMaximumPower = kPowerLag.maximum_power;

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
double LagRate(double distance) {
  return std::clamp(kPowerLag.rate_offset_per_s - kPowerLag.rate_slope_per_s * distance,
                    kPowerLag.min_rate_per_s, kPowerLag.max_rate_per_s);
}

}  // namespace

double PowerCommand(double throttle) {
  throttle = std::clamp(throttle, 0.0, 1.0);
  const ThrottleGearing& gearing = kThrottleGearing;
  return throttle <= gearing.military_throttle
             ? gearing.dry_gain * throttle
             : gearing.afterburner_gain * throttle + gearing.afterburner_offset;
}

double ThrottleForPower(double power) {
  const ThrottleGearing& gearing = kThrottleGearing;
  const double dry = power / gearing.dry_gain;
  const double throttle = dry <= gearing.military_throttle
                              ? dry
                              : (power - gearing.afterburner_offset) / gearing.afterburner_gain;
  return std::clamp(throttle, 0.0, 1.0);
}

double PowerRate(double power, double power_command) {
  // Crossing military power, the engine first heads for a point on its own side of the gap at a
  // rate of its own; only then for the command.
  if (power >= kMilitaryPower) {
    const double target =
        power_command >= kMilitaryPower ? power_command : kPowerLag.blow_out_power;
    return kPowerLag.afterburner_rate_per_s * (target - power);
  }
  const double target = power_command >= kMilitaryPower ? kPowerLag.light_up_power : power_command;
  return LagRate(target - power) * (target - power);
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
