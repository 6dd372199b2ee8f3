// SPDX-License-Identifier: Apache-2.0
#include "envs/air/atmosphere.h"

#include <algorithm>
#include <cmath>

#include "envs/air/atmosphere_constants.h"

namespace skein {
namespace {

Air StevensLewis(double altitude_ft) {
  const StevensLewisConstants& k = kStevensLewis;
  const double temperature_ratio = 1 - k.lapse_per_ft * altitude_ft;
  Air air;
  air.temperature_degR = altitude_ft >= k.tropopause_ft
                             ? k.stratosphere_temperature_degR
                             : k.sea_level_temperature_degR * temperature_ratio;
  air.density_slug_ft3 =
      k.sea_level_density_slug_ft3 *
      std::pow(std::max(temperature_ratio, k.min_temperature_ratio), k.density_exponent);
  air.sound_speed_ft_s =
      std::sqrt(kSpecificHeatRatio * k.sound_gas_constant * air.temperature_degR);
  air.pressure_lbf_ft2 = k.pressure_gas_constant * air.density_slug_ft3 * air.temperature_degR;
  return air;
}

Air Standard1976(double altitude_ft) {
  const Standard1976Constants& k = kStandard1976;
  const double geopotential_ft =
      k.earth_radius_ft * altitude_ft / (k.earth_radius_ft + altitude_ft);
  Air air;
  air.temperature_degR = k.sea_level_temperature_degR +
                         k.lapse_degR_per_ft * std::min(geopotential_ft, k.tropopause_ft);
  air.pressure_lbf_ft2 = k.sea_level_pressure_lbf_ft2 *
                         std::pow(air.temperature_degR / k.sea_level_temperature_degR,
                                  -k.gravity_ft_s2 / (k.lapse_degR_per_ft * k.gas_constant));
  if (geopotential_ft > k.tropopause_ft) {
    air.pressure_lbf_ft2 *= std::exp(-k.gravity_ft_s2 * (geopotential_ft - k.tropopause_ft) /
                                     (k.gas_constant * air.temperature_degR));
  }
  air.density_slug_ft3 = air.pressure_lbf_ft2 / (k.gas_constant * air.temperature_degR);
  air.sound_speed_ft_s = std::sqrt(kSpecificHeatRatio * k.gas_constant * air.temperature_degR);
  return air;
}

}  // namespace

Air AirAt(AtmosphereModel model, double altitude_ft) {
  return model == AtmosphereModel::kStevensLewis ? StevensLewis(altitude_ft)
                                                 : Standard1976(altitude_ft);
}

}  // namespace skein
