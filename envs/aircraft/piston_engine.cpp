// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/piston_engine.h"

#include <algorithm>
#include <cmath>

#include "envs/air/atmosphere.h"
#include "envs/aircraft/table_lookup.h"
#include "envs/aircraft/units.h"

namespace skein {
namespace {

constexpr double kTwoPi = 6.283185307179586477;
constexpr double kLowestAltitude_ft = -2000;

double DensityAt(double altitude_ft) {
  return AirAt(AtmosphereModel::kStandard1976, altitude_ft).density_slug_ft3 * kKgM3PerSlugFt3;
}

double At(const std::vector<double>& axis, const std::vector<double>& values, double x) {
  return Interpolate(values, Locate(axis, x));
}

/// The speed, rev/s, at which the propeller takes the engine's torque, N m. Of a windmilling
/// propeller, CP below zero, too.
double FixedPitchSpeed(const PistonEngine& engine, double torque, double airspeed, double density) {
  constexpr double kSlowest = 0.1, kOverspeed = 4;
  constexpr int kHalvings = 60;
  double low = kSlowest, high = kOverspeed * engine.rated_rpm / 60;
  for (int i = 0; i < kHalvings; ++i) {
    const double n = (low + high) / 2;
    const double CP = At(engine.advance_ratio, engine.CP, airspeed / (n * engine.diameter_m));
    const double taken = CP * density * n * n * std::pow(engine.diameter_m, 5) / kTwoPi;
    (taken < torque ? low : high) = n;
  }
  return (low + high) / 2;
}

/// efficiency / J, which at J = 0 is the slope of the first cell.
double EfficiencyPerAdvanceRatio(const PistonEngine& engine, double J) {
  const double first = engine.advance_ratio[1];
  return At(engine.advance_ratio, engine.efficiency, std::max(J, first)) / std::max(J, first);
}

}  // namespace

double PowerFraction(const PistonEngine& engine, double altitude_ft) {
  if (!engine.altitude_m.empty()) {
    return At(engine.altitude_m, engine.power_fraction, altitude_ft * kMetresPerFoot);
  }
  return std::max(0.0, 1.132 * DensityAt(altitude_ft) / DensityAt(0) - 0.132);
}

double PistonThrust(const PistonEngine& engine, double throttle, double airspeed_m_s,
                    double altitude_ft) {
  const double D = engine.diameter_m, rated = engine.rated_rpm / 60;
  const double power = engine.rated_power_W * throttle * PowerFraction(engine, altitude_ft);
  if (engine.propeller == PropellerModel::kConstantSpeed) {
    return power / (rated * D) * EfficiencyPerAdvanceRatio(engine, airspeed_m_s / (rated * D));
  }
  const double density = DensityAt(altitude_ft);
  if (engine.propeller == PropellerModel::kPolar) {
    return engine.polar_slope * power / (rated * D) +
           engine.polar_intercept * density * airspeed_m_s * airspeed_m_s * D * D;
  }
  const double n = FixedPitchSpeed(engine, power / (kTwoPi * rated), airspeed_m_s, density);
  const double CT = At(engine.advance_ratio, engine.CT, airspeed_m_s / (n * D));
  return CT * density * n * n * std::pow(D, 4);
}

EngineTables TabulatePiston(const PistonEngine& engine, const ThrottleLevels& levels,
                            const ThrustRange& range) {
  constexpr int kAltitudes = 4, kMachs = 9;
  EngineTables tables;
  for (int i = 0; i < kAltitudes; ++i) {
    tables.altitude_ft.push_back(kLowestAltitude_ft +
                                 (range.altitude_ft - kLowestAltitude_ft) * i / (kAltitudes - 1));
  }
  for (int j = 0; j < kMachs; ++j) tables.mach.push_back(range.mach * j / (kMachs - 1));
  for (const double altitude_ft : tables.altitude_ft) {
    const double sound = AirAt(AtmosphereModel::kStandard1976, altitude_ft).sound_speed_ft_s;
    for (const double mach : tables.mach) {
      const auto thrust_lbf = [&](double throttle) {
        return PistonThrust(engine, throttle, mach * sound * kMetresPerFoot, altitude_ft) /
               kNewtonsPerLbf;
      };
      tables.idle_lbf.push_back(thrust_lbf(levels.idle));
      tables.military_lbf.push_back(thrust_lbf(levels.military));
      tables.maximum_lbf.push_back(thrust_lbf(levels.maximum));
    }
  }
  return tables;
}

}  // namespace skein
