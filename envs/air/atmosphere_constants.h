// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

inline constexpr double kSpecificHeatRatio = 1.4;

/// Stevens and Lewis, Aircraft Control and Simulation, subroutine ADC. Density follows its power
/// law above the tropopause too; the static pressure uses a gas constant of 1715 as printed there.
struct StevensLewisConstants {
  double lapse_per_ft = 0.703e-5;  ///< of the temperature's ratio to that at sea level
  double sea_level_temperature_degR = 519;
  double tropopause_ft = 35000;
  double stratosphere_temperature_degR = 390;
  double sea_level_density_slug_ft3 = 2.377e-3;
  double density_exponent = 4.14;
  double sound_gas_constant = 1716.3;   ///< ft lbf / (slug degR)
  double pressure_gas_constant = 1715;  ///< ft lbf / (slug degR)
  /// Keeps the power law defined far above any flight.
  double min_temperature_ratio = 1e-3;
};
inline constexpr StevensLewisConstants kStevensLewis{};

/// U.S. Standard Atmosphere 1976, its two lowest layers, by geopotential altitude.
struct Standard1976Constants {
  double earth_radius_ft = 20855531.5;
  double sea_level_temperature_degR = 518.67;
  double lapse_degR_per_ft = -0.00356616;
  double tropopause_ft = 36089.24;
  double sea_level_pressure_lbf_ft2 = 2116.2166;
  double gas_constant = 1716.562;  ///< ft lbf / (slug degR): 287.0529 J / (kg K)
  double gravity_ft_s2 = 32.17405;
};
inline constexpr Standard1976Constants kStandard1976{};

}  // namespace skein
