// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>

#include "envs/aircraft/engine.h"
#include "envs/aircraft/f16.h"
#include "envs/reference/linear_flight.h"
#include "envs/reference/trim.h"
#include "envs/tuning/linear_modes.h"
#include "tests/envs/validation/book_f16.h"
#include "tests/envs/validation/sections.h"

namespace skein::validation {
namespace {

TrimPoint LevelTrim(const Plant& plant, double altitude_ft, double speed_ft_s) {
  TrimRequest level;
  level.altitude_ft = altitude_ft;
  level.true_airspeed_ft_s = speed_ft_s;
  return Trim(plant, level);
}

Plant At(double cg, Aircraft f16) {
  f16.airframe.cg = cg;
  return Plant(f16, AtmosphereModel::kStevensLewis);
}

/// The model whose tables Skein's F-16 has; its search stopped at accelerations of about 1e-3
/// ft/s^2 with the wings held level.
Section MinnesotaTrims() {
  Section section{"minnesota-trims", "published", {}};
  const auto add = [&](const char* what, double published, double skein, double tolerance,
                       int decimals) {
    section.figures.push_back(PublishedOnce(what, published, skein, tolerance, decimals));
  };
  const TrimPoint slow = LevelTrim(At(0.30, F16()), 9843, 393.72);
  add("thrust, lbf (9843 ft, 393.72 ft/s, cg 0.30)", 2279.0852, slow.controls.thrust_lbf, 0.2, 2);
  add("elevator, deg", -2.979732, slow.controls.elevator_deg, 3e-4, 5);
  add("aileron, deg", 0.008746, slow.controls.aileron_deg, 3e-4, 5);
  add("rudder, deg", 0.068030, slow.controls.rudder_deg, 1e-3, 5);
  add("alpha, deg", 6.623938, slow.alpha_rad * kDegPerRad, 6e-4, 5);
  const TrimPoint fast = LevelTrim(At(0.25, F16()), 10000, 700);
  add("thrust, lbf (10,000 ft, 700 ft/s, cg 0.25)", 2886.6468, fast.controls.thrust_lbf, 0.2, 2);
  add("elevator, deg", -2.0385, fast.controls.elevator_deg, 3e-4, 4);
  add("leading-edge flap, deg", 0.3986, fast.controls.leading_edge_flap_deg, 1e-3, 4);
  return section;
}

/// Table 3.6-3 of Stevens and Lewis: 502 ft/s at sea level.
Section StevensLewisTrims() {
  constexpr struct {
    double cg, alpha_rad, elevator_deg, throttle;
  } kRows[] = {{0.30, 0.03936, -1.931, 0.1485},
               {0.35, 0.03691, -0.7588, 0.1385},
               {0.38, 0.03544, -0.0559, 0.1325}};
  constexpr double kAlphaDigits = 1e-5, kElevatorDigits = 6e-4, kThrottleDigits = 6e-5;
  Section section{"stevens-lewis-trims", "published", {}};
  for (const auto& row : kRows) {
    const Plant plant = At(row.cg, BookF16());
    const TrimPoint trim = LevelTrim(plant, 0, 502);
    const std::string at = " (cg 0." + std::to_string(std::lround(100 * row.cg)) + ")";
    section.figures.push_back(
        PublishedOnce("alpha, rad" + at, row.alpha_rad, trim.alpha_rad, kAlphaDigits, 5));
    section.figures.push_back(PublishedOnce("elevator, deg" + at, row.elevator_deg,
                                            trim.controls.elevator_deg, kElevatorDigits, 4));
    section.figures.push_back(PublishedOnce(
        "throttle" + at, row.throttle,
        ThrottleForPower(plant.aircraft().throttle_gearing, trim.power), kThrottleDigits, 4));
  }
  return section;
}

/// Section 3.8 of Stevens and Lewis: the same flight, centre of gravity at 0.30.
Section StevensLewisModes() {
  constexpr double kDigits = 1.5e-3;  // and what couples the axes; of the whole mode
  const std::complex<double> kModes[] = {
      {-1.2039, 1.4922}, {-0.0087, 0.0739}, {-0.4399, 3.220}, {-3.601, 0}, {-0.0128, 0}};
  const Plant plant = At(0.30, BookF16());
  const std::vector<FlightMode> modes =
      FindFlightModes(LineariseFlight(plant, LevelTrim(plant, 0, 502), FlapMotion::kFixed));
  Section section{"stevens-lewis-modes", "published", {}};
  for (std::size_t i = 0; i < std::size(kModes); ++i) {
    const double tolerance = kDigits * std::max(0.1, std::abs(kModes[i]));
    const std::complex<double> mode = modes.at(i).eigenvalue;
    section.figures.push_back(PublishedOnce(modes.at(i).name + ": real part, 1/s", kModes[i].real(),
                                            mode.real(), tolerance, 4));
    if (kModes[i].imag() == 0) continue;
    section.figures.push_back(PublishedOnce(modes.at(i).name + ": imaginary part, rad/s",
                                            kModes[i].imag(), mode.imag(), tolerance, 4));
  }
  return section;
}

}  // namespace

std::vector<Section> PublishedTrims() {
  return {MinnesotaTrims(), StevensLewisTrims(), StevensLewisModes()};
}

}  // namespace skein::validation
