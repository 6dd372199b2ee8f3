#include "envs/air/atmosphere.h"

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

constexpr double kSpecificHeatRatio = 1.4;

/// Stevens and Lewis, Aircraft Control and Simulation, subroutine ADC. Density follows its power
/// law above the tropopause too; the static pressure uses a gas constant of 1715 as printed there.
Air StevensLewis(double altitude_ft) {
  constexpr double kLapsePerFt = 0.703e-5;
  constexpr double kSeaLevelTemperature = 519;
  constexpr double kTropopauseFt = 35000;
  constexpr double kStratosphereTemperature = 390;
  constexpr double kSeaLevelDensity = 2.377e-3;
  constexpr double kDensityExponent = 4.14;
  constexpr double kGasConstantSound = 1716.3;
  constexpr double kGasConstantPressure = 1715;
  // Keeps the power law defined far above any flight.
  constexpr double kMinTemperatureRatio = 1e-3;

  const double temperature_ratio = 1 - kLapsePerFt * altitude_ft;
  Air air;
  air.temperature_degR = altitude_ft >= kTropopauseFt ? kStratosphereTemperature
                                                      : kSeaLevelTemperature * temperature_ratio;
  air.density_slug_ft3 =
      kSeaLevelDensity *
      std::pow(std::max(temperature_ratio, kMinTemperatureRatio), kDensityExponent);
  air.sound_speed_ft_s = std::sqrt(kSpecificHeatRatio * kGasConstantSound * air.temperature_degR);
  air.pressure_lbf_ft2 = kGasConstantPressure * air.density_slug_ft3 * air.temperature_degR;
  return air;
}

/// U.S. Standard Atmosphere 1976, its two lowest layers.
Air Standard1976(double altitude_ft) {
  constexpr double kEarthRadiusFt = 20855531.5;
  constexpr double kSeaLevelTemperature = 518.67;
  constexpr double kLapsePerFt = -0.00356616;
  constexpr double kTropopauseFt = 36089.24;
  constexpr double kSeaLevelPressure = 2116.2166;
  constexpr double kGasConstant = 1716.49;
  constexpr double kStandardGravity = 32.17405;

  const double geopotential_ft = kEarthRadiusFt * altitude_ft / (kEarthRadiusFt + altitude_ft);
  Air air;
  air.temperature_degR =
      kSeaLevelTemperature + kLapsePerFt * std::min(geopotential_ft, kTropopauseFt);
  air.pressure_lbf_ft2 =
      kSeaLevelPressure * std::pow(air.temperature_degR / kSeaLevelTemperature,
                                   -kStandardGravity / (kLapsePerFt * kGasConstant));
  if (geopotential_ft > kTropopauseFt) {
    air.pressure_lbf_ft2 *= std::exp(-kStandardGravity * (geopotential_ft - kTropopauseFt) /
                                     (kGasConstant * air.temperature_degR));
  }
  air.density_slug_ft3 = air.pressure_lbf_ft2 / (kGasConstant * air.temperature_degR);
  air.sound_speed_ft_s = std::sqrt(kSpecificHeatRatio * kGasConstant * air.temperature_degR);
  return air;
}

}  // namespace

Air AirAt(AtmosphereModel model, double altitude_ft) {
  return model == AtmosphereModel::kStevensLewis ? StevensLewis(altitude_ft)
                                                 : Standard1976(altitude_ft);
}

}  // namespace skein
