// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/propeller.h"

#include <cmath>

#include "envs/air/atmosphere.h"
#include "envs/aircraft/units.h"

namespace skein {
namespace {

constexpr double kTwoPi = 6.283185307179586477;

}  // namespace

double PropellerThrust(const Propeller& propeller, double motor_throttle, double airspeed_m_s,
                       double density_kg_m3) {
  const double D = propeller.diameter_m, V = airspeed_m_s, rho = density_kg_m3;
  const double volts = propeller.max_voltage_V * motor_throttle;
  // Torque per ampere, N m/A, is what volts per speed, V s/rad, are.
  const double K = 60 / (kTwoPi * propeller.speed_constant_rpm_per_V);
  // The motor's torque less the propeller's, a quadratic in the speed omega, rad/s, vanishes:
  //   K ((volts - K omega) / R - i0) = rho D^5 (omega / 2 pi)^2 C_Q(J).
  const double a = rho * std::pow(D, 5) * propeller.CQ_0 / (kTwoPi * kTwoPi);
  const double b =
      rho * std::pow(D, 4) * propeller.CQ_1 * V / kTwoPi + K * K / propeller.resistance_ohm;
  const double c = rho * std::pow(D, 3) * propeller.CQ_2 * V * V -
                   K * (volts / propeller.resistance_ohm - propeller.no_load_current_A);
  const double turns_per_s = (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a) / kTwoPi;
  return rho * D * D *
         (propeller.CT_0 * turns_per_s * turns_per_s * D * D +
          propeller.CT_1 * turns_per_s * D * V + propeller.CT_2 * V * V);
}

EngineTables TabulatePropeller(const Propeller& propeller, const PropellerLevels& levels,
                               const PropellerCells& cells) {
  EngineTables tables;
  for (int i = 0; i <= PropellerCells::kAltitudes; ++i) {
    tables.altitude_ft.push_back(PropellerCells::kLowestAltitude_ft + cells.altitude_ft * i);
  }
  for (int j = 0; j <= PropellerCells::kMachs; ++j) tables.mach.push_back(cells.mach * j);
  for (const double altitude_ft : tables.altitude_ft) {
    const Air air = AirAt(AtmosphereModel::kStandard1976, altitude_ft);
    const double density = air.density_slug_ft3 * kKgM3PerSlugFt3;
    for (const double mach : tables.mach) {
      const double airspeed = mach * air.sound_speed_ft_s / kFeetPerMetre;
      const auto thrust_lbf = [&](double motor_throttle) {
        return PropellerThrust(propeller, motor_throttle, airspeed, density) / kNewtonsPerLbf;
      };
      tables.idle_lbf.push_back(thrust_lbf(levels.idle));
      tables.military_lbf.push_back(thrust_lbf(levels.military));
      tables.maximum_lbf.push_back(thrust_lbf(levels.maximum));
    }
  }
  return tables;
}

}  // namespace skein
