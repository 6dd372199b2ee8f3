// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>

#include "envs/aircraft/f16.h"
#include "envs/reference/aerodynamics.h"
#include "envs/reference/flight_control.h"
#include "envs/reference/linearise.h"
#include "envs/reference/trim.h"
#include "tests/envs/validation/check_cases.h"
#include "tests/envs/validation/rotating_earth.h"
#include "tests/envs/validation/sections.h"

namespace skein::validation {
namespace {

using nlohmann::json;

constexpr const char* kCoefficients[] = {"CX", "CY", "CZ", "Cl", "Cm", "Cn"};

/// How far the coefficients of a wind-tunnel report may be from a textbook's short form of them,
/// without its flap.
double OtherTables(double published) { return std::max(0.02, 0.05 * std::abs(published)); }

/// Skein's coefficients for the inputs of a static shot, about the tables' own centre, the flap
/// where it is in steady flight at sea level.
Eigen::Matrix<double, 6, 1> Coefficients(const json& inputs) {
  constexpr double kSpeedFtS = 300;
  Aircraft f16 = F16();
  f16.airframe.cg = f16.airframe.cg_reference;
  const auto input = [&inputs](int i) { return inputs.at(i).get<double>(); };
  const Air air = AirAt(AtmosphereModel::kStandard1976, 0);
  AerodynamicCondition condition;
  condition.alpha_deg = input(0);
  condition.beta_deg = input(1);
  condition.p_hat = input(2) * f16.airframe.span_ft / (2 * kSpeedFtS);
  condition.q_hat = input(3) * f16.airframe.chord_ft / (2 * kSpeedFtS);
  condition.r_hat = input(4) * f16.airframe.span_ft / (2 * kSpeedFtS);
  condition.elevator_deg = input(5);
  condition.aileron_deg = input(6);
  condition.rudder_deg = input(7);
  condition.leading_edge_flap_deg = SteadyLeadingEdgeFlap(
      f16, condition.alpha_deg, 0.5 * air.density_slug_ft3 * kSpeedFtS * kSpeedFtS,
      air.pressure_lbf_ft2);
  return EvaluateAerodynamics(f16, condition);
}

/// One coefficient's slope by one input, between a static shot and its mirror image.
struct Slope {
  const char* name;
  int shot;   ///< of the positive input; the negative one follows
  int input;  ///< which is varied
  int coefficient;
  double scale;  ///< of the slope: what makes it one by dimensionless rate, or by ten degrees
};

Section StaticShots() {
  constexpr double kPerSpan = 2 * 300 / 30.0, kPerChord = 2 * 300 / 11.32, kTenDegrees = 10;
  constexpr Slope kSlopes[] = {
      {"CY by 10 deg of sideslip", 1, 1, 1, kTenDegrees},
      {"Cl by 10 deg of sideslip", 1, 1, 3, kTenDegrees},
      {"Cn by 10 deg of sideslip", 1, 1, 5, kTenDegrees},
      {"CY by p b / 2V", 3, 2, 1, kPerSpan},
      {"Cl by p b / 2V", 3, 2, 3, kPerSpan},
      {"Cn by p b / 2V", 3, 2, 5, kPerSpan},
      {"CX by q c / 2V", 5, 3, 0, kPerChord},
      {"CZ by q c / 2V", 5, 3, 2, kPerChord},
      {"Cm by q c / 2V", 5, 3, 4, kPerChord},
      {"CY by r b / 2V", 7, 4, 1, kPerSpan},
      {"Cl by r b / 2V", 7, 4, 3, kPerSpan},
      {"Cn by r b / 2V", 7, 4, 5, kPerSpan},
      {"CZ by 10 deg of elevator", 9, 5, 2, kTenDegrees},
      {"Cm by 10 deg of elevator", 9, 5, 4, kTenDegrees},
      {"CY by 10 deg of aileron", 11, 6, 1, kTenDegrees},
      {"Cl by 10 deg of aileron", 11, 6, 3, kTenDegrees},
      {"Cn by 10 deg of aileron", 11, 6, 5, kTenDegrees},
      {"CY by 10 deg of rudder", 13, 7, 1, kTenDegrees},
      {"Cl by 10 deg of rudder", 13, 7, 3, kTenDegrees},
      {"Cn by 10 deg of rudder", 13, 7, 5, kTenDegrees},
  };
  const json& shots = CheckCases().at("static_shots");
  Section section{"static-shots", "S-119", {}};
  const json& nominal = shots.at(0);
  for (const int k : {0, 2, 4}) {
    const double published = nominal.at("coefficients").at(k).get<double>();
    section.figures.push_back(PublishedOnce(kCoefficients[k], published,
                                            Coefficients(nominal.at("inputs"))[k],
                                            OtherTables(published), 4));
  }
  for (const Slope& slope : kSlopes) {
    const json &plus = shots.at(slope.shot), &minus = shots.at(slope.shot + 1);
    const double step = (plus.at("inputs").at(slope.input).get<double>() -
                         minus.at("inputs").at(slope.input).get<double>()) /
                        slope.scale;
    const double published = plus.at("coefficients").at(slope.coefficient).get<double>() -
                             minus.at("coefficients").at(slope.coefficient).get<double>();
    const double ours = Coefficients(plus.at("inputs"))[slope.coefficient] -
                        Coefficients(minus.at("inputs"))[slope.coefficient];
    section.figures.push_back(
        PublishedOnce(slope.name, published / step, ours / step, OtherTables(published / step), 4));
  }
  return section;
}

/// Level flight at 45 deg of heading over 36 deg of latitude, the sum of gravity and of what a
/// rotating, round earth takes off it being Skein's gravity.
void AddTrimmedCase(const char* number, const char* label, double altitude_ft, double speed_ft_s,
                    Section* section) {
  constexpr double kLatitudeDeg = 36.019167, kMassSlug = 637.1595;
  const json& check_case = CheckCases().at("cases").at(number);
  Aircraft f16 = F16();
  f16.airframe.cg = 0.25;
  f16.airframe.mass_slug = kMassSlug;
  const double each_way = speed_ft_s / std::sqrt(2);
  const Gravity gravity{
      GravityInLevelFlight(kLatitudeDeg / kDegPerRad, altitude_ft, each_way, each_way), false};
  const Plant plant(f16, AtmosphereModel::kStandard1976, 1, gravity);
  const TrimPoint trim = Trim(plant, {altitude_ft, speed_ft_s, 0, 0});
  const PlantOutput output = plant.Evaluate(trim.state, trim.controls);
  const double qbar_S = output.air.dynamic_pressure_psf * f16.airframe.wing_area_ft2;
  const auto add = [&](const char* what, const char* quantity, double skein, double tolerance,
                       int decimals) {
    section->figures.push_back(PublishedOften(std::string(what) + label,
                                              Simulated(check_case, quantity, 0), skein, 0,
                                              tolerance, decimals));
  };
  constexpr double kHeldUp = 5, kOtherDragLbf = 1000, kOtherLiftDeg = 0.5;
  add("pitch, deg", "pitch_deg", trim.pitch_rad * kDegPerRad, kOtherLiftDeg, 3);
  add("aerodynamic force along body z, lbf", "aero_z_lbf", qbar_S * output.coefficients[2], kHeldUp,
      1);
  add("aerodynamic force along body x, lbf", "aero_x_lbf", qbar_S * output.coefficients[0],
      kOtherDragLbf, 1);
}

Section TrimmedCases() {
  Section section{"cases-11-12", "simulators", {}};
  AddTrimmedCase("11", ", case 11", 10013, 400 * std::sqrt(2), &section);
  AddTrimmedCase("12", ", case 12", 30013, 2000, &section);
  return section;
}

Plant F16At(double cg) {
  Aircraft f16 = F16();
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
  const TrimPoint slow = Trim(F16At(0.30), {9843, 393.72, 0, 0});
  add("thrust, lbf (9843 ft, 393.72 ft/s, cg 0.30)", 2279.0852, slow.controls.thrust_lbf, 0.2, 2);
  add("elevator, deg", -2.979732, slow.controls.elevator_deg, 3e-4, 5);
  add("aileron, deg", 0.008746, slow.controls.aileron_deg, 3e-4, 5);
  add("rudder, deg", 0.068030, slow.controls.rudder_deg, 1e-3, 5);
  add("alpha, deg", 6.623938, slow.alpha_rad * kDegPerRad, 6e-4, 5);
  const TrimPoint fast = Trim(F16At(0.25), {10000, 700, 0, 0});
  add("thrust, lbf (10,000 ft, 700 ft/s, cg 0.25)", 2886.6468, fast.controls.thrust_lbf, 0.2, 2);
  add("elevator, deg", -2.0385, fast.controls.elevator_deg, 3e-4, 4);
  add("leading-edge flap, deg", 0.3986, fast.controls.leading_edge_flap_deg, 1e-3, 4);
  return section;
}

/// Table 3.6-3 of Stevens and Lewis: 502 ft/s at sea level, their own aerodynamics.
Section StevensLewisTrims() {
  constexpr struct {
    double cg, alpha_rad, elevator_deg, throttle;
  } kRows[] = {{0.30, 0.03936, -1.931, 0.1485},
               {0.35, 0.03691, -0.7588, 0.1385},
               {0.38, 0.03544, -0.0559, 0.1325}};
  constexpr double kOtherAlphaDeg = 0.5, kOtherElevatorDeg = 0.7, kOtherThrottle = 0.05;
  Section section{"stevens-lewis-trims", "published", {}};
  for (const auto& row : kRows) {
    const Plant plant = F16At(row.cg);
    const TrimPoint trim = Trim(plant, {0, 502, 0, 0});
    const std::string at = " (cg 0." + std::to_string(std::lround(100 * row.cg)) + ")";
    section.figures.push_back(PublishedOnce("alpha, deg" + at, row.alpha_rad * kDegPerRad,
                                            trim.alpha_rad * kDegPerRad, kOtherAlphaDeg, 3));
    section.figures.push_back(PublishedOnce("elevator, deg" + at, row.elevator_deg,
                                            trim.controls.elevator_deg, kOtherElevatorDeg, 3));
    section.figures.push_back(PublishedOnce("throttle" + at, row.throttle,
                                            trim.power / plant.aircraft().throttle_gearing.dry_gain,
                                            kOtherThrottle, 4));
  }
  return section;
}

/// The eigenvalue next to `expected`.
std::complex<double> Mode(double cg, double altitude_ft, double speed_ft_s,
                          std::complex<double> expected) {
  const Plant plant = F16At(cg);
  const TrimPoint trim = Trim(plant, {altitude_ft, speed_ft_s, 0, 0});
  const Eigen::VectorXcd modes = Linearise(plant, trim.state, trim.controls).A.eigenvalues();
  Eigen::Index nearest = 0;
  (modes.array() - expected).abs().minCoeff(&nearest);
  return modes[nearest];
}

Section Modes() {
  const struct {
    const char* name;
    double cg, altitude_ft, speed_ft_s;
    std::complex<double> mode;
  } kRows[] = {{"short period, cg 0.30, 15,000 ft, 500 ft/s", 0.30, 15000, 500, {-0.781, 0.727}},
               {"short period, cg 0.30, 30,000 ft, 800 ft/s", 0.30, 30000, 800, {-0.731, 0.760}},
               {"short period, cg 0.25, 15,000 ft, 500 ft/s", 0.25, 15000, 500, {-0.883, 1.621}},
               {"divergence, cg 0.35, 15,000 ft, 500 ft/s", 0.35, 15000, 500, {0.595, 0}},
               {"Dutch roll, cg 0.30, 15,000 ft, 500 ft/s", 0.30, 15000, 500, {-0.315, 2.523}},
               {"roll, cg 0.30, 15,000 ft, 500 ft/s", 0.30, 15000, 500, {-2.09, 0}},
               {"spiral, cg 0.30, 15,000 ft, 500 ft/s", 0.30, 15000, 500, {-0.017, 0}}};
  constexpr double kDigits = 2e-3;
  Section section{"modes", "other model", {}};
  for (const auto& row : kRows) {
    const std::complex<double> mode = Mode(row.cg, row.altitude_ft, row.speed_ft_s, row.mode);
    const std::string name = row.name;
    section.figures.push_back(
        PublishedOnce(name + ": real part, 1/s", row.mode.real(), mode.real(), kDigits, 3));
    if (row.mode.imag() == 0) continue;
    section.figures.push_back(
        PublishedOnce(name + ": imaginary part, rad/s", row.mode.imag(), mode.imag(), kDigits, 3));
  }
  return section;
}

}  // namespace

std::vector<Section> PublishedF16Figures() {
  return {TrimmedCases(), StaticShots(), MinnesotaTrims(), StevensLewisTrims(), Modes()};
}

}  // namespace skein::validation
