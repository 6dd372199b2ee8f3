// SPDX-License-Identifier: Apache-2.0
#include "envs/air/atmosphere.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tolerance.h"

namespace skein {
namespace {

// U.S. Standard Atmosphere 1976 (NOAA-S/T 76-1562), at geometric altitudes of round geopotential
// ones: temperature K, pressure Pa, density kg/m^3 at 0, 5, 11 and 15 km geopotential.
struct StandardRow {
  double geopotential_m, temperature_K, pressure_Pa, density_kg_m3;
};
constexpr StandardRow kStandardRows[] = {
    {0, 288.15, 101325, 1.2250},
    {5000, 255.65, 54019.9, 0.73612},
    {11000, 216.65, 22632.1, 0.36392},
    {15000, 216.65, 12044.6, 0.19367},
};
constexpr Tolerance kPublishedDigits{5e-5, "five digits of the table and of unit conversions"};
constexpr Tolerance kCentralDifference{1e-8, "second differences over a foot, rounded"};

double GeometricFt(double geopotential_m) {
  constexpr double kEarthRadiusM = 6356766;
  return kEarthRadiusM * geopotential_m / (kEarthRadiusM - geopotential_m) / 0.3048;
}

TEST(Atmosphere, Standard1976MatchesThePublishedTable) {
  for (const StandardRow& row : kStandardRows) {
    SCOPED_TRACE(row.geopotential_m);
    const Air air = AirAt(AtmosphereModel::kStandard1976, GeometricFt(row.geopotential_m));
    EXPECT_NEAR(air.temperature_degR / 1.8 / row.temperature_K, 1, kPublishedDigits);
    EXPECT_NEAR(air.pressure_lbf_ft2 * 47.880259 / row.pressure_Pa, 1, kPublishedDigits);
    EXPECT_NEAR(air.density_slug_ft3 * 515.378818 / row.density_kg_m3, 1, kPublishedDigits);
    const double sound = std::sqrt(1.4 * 287.053 * row.temperature_K) / 0.3048;
    EXPECT_NEAR(air.sound_speed_ft_s / sound, 1, kPublishedDigits);
  }
}

TEST(Atmosphere, Standard1976IsHydrostaticAndContinuous) {
  // Geometric steps carry geopotential gravity: g falls with (R / (R + h))^2.
  constexpr double kStepFt = 1;
  for (double altitude = 0; altitude < 65000; altitude += 997) {
    const Air below = AirAt(AtmosphereModel::kStandard1976, altitude - kStepFt);
    const Air at = AirAt(AtmosphereModel::kStandard1976, altitude);
    const Air above = AirAt(AtmosphereModel::kStandard1976, altitude + kStepFt);
    const double ratio = 20855531.5 / (20855531.5 + altitude);
    const double slope = (above.pressure_lbf_ft2 - below.pressure_lbf_ft2) / (2 * kStepFt);
    EXPECT_NEAR(slope / (-32.17405 * ratio * ratio * at.density_slug_ft3), 1, kCentralDifference)
        << altitude;
  }
}

// How far the published models' atmosphere lies from the standard one, %: density, temperature
// degR, sound speed %, pressure %. Rounded to the digits shown.
struct Difference {
  double altitude_ft, density, temperature_degR, sound, pressure;
};
constexpr Tolerance kDigits{0.01, "two decimals shown"};
constexpr Tolerance kDigitsAbove{0.06, "one decimal shown"};
constexpr Difference kDifferences[] = {
    {0, 0.00, 0.33, 0.03, -0.02},       {10000, 0.13, -0.51, -0.06, -0.07},
    {20000, 0.17, -1.39, -0.16, -0.23}, {30000, 0.10, -2.30, -0.28, -0.54},
    {40000, 3.2, 0.03, 0.00, 3.1},      {50000, 8.7, 0.03, 0.00, 8.6},
};

TEST(Atmosphere, StevensLewisLiesAsFarFromTheStandardAsKnown) {
  for (const Difference& known : kDifferences) {
    SCOPED_TRACE(known.altitude_ft);
    const double digits = known.altitude_ft < 35000 ? kDigits : kDigitsAbove;
    const Air a = AirAt(AtmosphereModel::kStevensLewis, known.altitude_ft);
    const Air b = AirAt(AtmosphereModel::kStandard1976, known.altitude_ft);
    EXPECT_NEAR(100 * (a.density_slug_ft3 / b.density_slug_ft3 - 1), known.density, digits);
    EXPECT_NEAR(a.temperature_degR - b.temperature_degR, known.temperature_degR, kDigits);
    EXPECT_NEAR(100 * (a.sound_speed_ft_s / b.sound_speed_ft_s - 1), known.sound, kDigits);
    EXPECT_NEAR(100 * (a.pressure_lbf_ft2 / b.pressure_lbf_ft2 - 1), known.pressure, digits);
  }
}

TEST(Atmosphere, StaysPositiveFarAbove) {
  for (double altitude : {1e5, 1.5e5, 1e6}) {
    EXPECT_GT(AirAt(AtmosphereModel::kStevensLewis, altitude).density_slug_ft3, 0);
    EXPECT_GT(AirAt(AtmosphereModel::kStandard1976, altitude).density_slug_ft3, 0);
  }
}

}  // namespace
}  // namespace skein
