// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "envs/air/atmosphere.h"
#include "envs/aircraft/f16.h"
#include "tests/envs/validation/sections.h"
#include "tests/envs/wind/gusts.h"

namespace skein::validation {
namespace {

/// U.S. Standard Atmosphere 1976, table I, by geopotential altitude.
Section StandardAtmosphere() {
  constexpr double kEarthRadiusM = 6356766, kDigits = 5e-5;
  constexpr struct {
    double geopotential_m, temperature_K, pressure_Pa, density_kg_m3;
  } kRows[] = {{0, 288.15, 101325, 1.2250},
               {5000, 255.65, 54019.9, 0.73612},
               {11000, 216.65, 22632.1, 0.36392},
               {15000, 216.65, 12044.6, 0.19367}};
  Section section{"standard-atmosphere", "published", {}};
  for (const auto& row : kRows) {
    const double altitude_ft =
        kEarthRadiusM * row.geopotential_m / (kEarthRadiusM - row.geopotential_m) / 0.3048;
    const Air air = AirAt(AtmosphereModel::kStandard1976, altitude_ft);
    const std::string at = ", " + std::to_string(static_cast<int>(row.geopotential_m)) + " m";
    const auto add = [&](const char* what, double published, double skein, int decimals) {
      section.figures.push_back(
          PublishedOnce(what + at, published, skein, kDigits * published, decimals));
    };
    add("temperature, K", row.temperature_K, air.temperature_degR / 1.8, 3);
    add("pressure, Pa", row.pressure_Pa, air.pressure_lbf_ft2 * 47.880259, 1);
    add("density, kg/m³", row.density_kg_m3, air.density_slug_ft3 * 515.378818, 5);
  }
  return section;
}

/// The published F-16 models' own air, in per cent of the standard's.
Section ModelAtmosphere() {
  constexpr double kBelow = 0.2, kAbove = 9;  // their tropopause, %
  Section section{"model-atmosphere", "standard", {}};
  for (int altitude_ft = 0; altitude_ft <= 50000; altitude_ft += 10000) {
    const double ratio = AirAt(AtmosphereModel::kStevensLewis, altitude_ft).density_slug_ft3 /
                         AirAt(AtmosphereModel::kStandard1976, altitude_ft).density_slug_ft3;
    section.figures.push_back(PublishedOnce("density, %, " + std::to_string(altitude_ft) + " ft",
                                            100, 100 * ratio,
                                            altitude_ft <= 35000 ? kBelow : kAbove, 2));
  }
  return section;
}

/// Spectral densities of Skein's gusts over those of MIL-F-8785C.
Section TurbulenceSpectra() {
  constexpr double kScaleFt = 1750;
  constexpr const char* kComponents[] = {"forward", "right", "down"};
  const MeasuredSpectra spectra;
  Section section{"turbulence-spectra", "MIL-F-8785C", {}};
  for (int k = 0; k < 3; ++k) {
    for (const int cycles : {3, 8, 21, 60}) {
      const double frequency = spectra.Frequency(cycles);
      const double standard = Spectrum(k, kScaleFt, frequency);
      char what[80];
      std::snprintf(what, sizeof what, "%s gust, density at L Ω = %.2f, ft/rad", kComponents[k],
                    kScaleFt * frequency);
      section.figures.push_back(
          PublishedOnce(what, standard, spectra.Density(k, cycles), kPeriodogram * standard, 1));
    }
  }
  return section;
}

/// Likewise of its rotational gusts, for the F-16's span.
Section RotationalGustSpectra() {
  constexpr double kScaleFt = 1750, kDt = 0.01;
  constexpr const char* kRates[] = {"roll", "pitch", "yaw"};
  const double span_ft = F16().airframe.span_ft;
  const MeasuredSpectra spectra(kDt, span_ft);
  Section section{"rotational-gust-spectra", "MIL-F-8785C", {}};
  for (int k = 0; k < 3; ++k) {
    for (const int cycles : {3, 8, 21, 60}) {
      const double frequency = spectra.Frequency(cycles);
      const double standard = RateSpectrum(3 + k, kScaleFt, span_ft, frequency);
      char what[80];
      std::snprintf(what, sizeof what, "%s rate, density at b Ω = %.3f, 1/(ft rad)", kRates[k],
                    span_ft * frequency);
      section.figures.push_back(PublishedOnce(what, standard, spectra.Density(3 + k, cycles),
                                              kPeriodogram * standard, 6));
    }
  }
  return section;
}

}  // namespace

std::vector<Section> PublishedAirFigures() {
  return {StandardAtmosphere(), ModelAtmosphere(), TurbulenceSpectra(), RotationalGustSpectra()};
}

}  // namespace skein::validation
