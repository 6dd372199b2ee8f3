// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <utility>

namespace skein {

enum class AtmosphereModel {
  kStevensLewis,  ///< the published F-16 models' polynomial atmosphere (Stevens and Lewis)
  kStandard1976,  ///< U.S. Standard Atmosphere 1976, geopotential, to 65,600 ft
};
inline constexpr std::array<std::pair<AtmosphereModel, const char*>, 2> kAtmosphereNames{
    {{AtmosphereModel::kStevensLewis, "stevens_lewis"},
     {AtmosphereModel::kStandard1976, "standard_1976"}}};

/// The air at rest at one altitude.
struct Air {
  double density_slug_ft3 = 0;
  double temperature_degR = 0;
  double sound_speed_ft_s = 0;
  double pressure_lbf_ft2 = 0;
};

/// Air at geometric altitude `altitude_ft` above sea level.
Air AirAt(AtmosphereModel model, double altitude_ft);

}  // namespace skein
