// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "envs/aircraft/f16.h"
#include "envs/reference/aerodynamics.h"
#include "envs/reference/flight_control.h"
#include "envs/reference/trim.h"
#include "tests/envs/validation/book_f16.h"
#include "tests/envs/validation/check_cases.h"
#include "tests/envs/validation/rotating_earth.h"
#include "tests/envs/validation/sections.h"

namespace skein::validation {
namespace {

using nlohmann::json;

constexpr const char* kCoefficients[] = {"CX", "CY", "CZ", "Cl", "Cm", "Cn"};

/// Which F-16 flies, and how far it may be from S-119, which has the book's tables: by digits
/// printed, or, of the report that these are the short form of, by more.
struct Model {
  Aircraft aircraft;
  double share, least;                      ///< of a coefficient's slope, and whatever that is
  double pitch_deg, normal_lbf, axial_lbf;  ///< of a trim

  double ToleranceOf(double published) const {
    return std::max(least, share * std::abs(published));
  }
};

Model BookModel() { return {BookF16(), 1e-6, 1e-6, 5e-4, 0.2, 0.2}; }
Model ReportModel() { return {F16(), 0.05, 0.02, 0.05, 5, 1000}; }

/// A model's coefficients for the inputs of a static shot, about the tables' own centre, a flap
/// where it is in steady flight at sea level.
Eigen::Matrix<double, 6, 1> Coefficients(Aircraft f16, const json& inputs) {
  constexpr double kSpeedFtS = 300;
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

Section StaticShots(const char* name, const Model& model) {
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
  Section section{name, "S-119", {}};
  const json& nominal = shots.at(0);
  for (const int k : {0, 2, 4}) {
    const double published = nominal.at("coefficients").at(k).get<double>();
    section.figures.push_back(PublishedOnce(kCoefficients[k], published,
                                            Coefficients(model.aircraft, nominal.at("inputs"))[k],
                                            model.ToleranceOf(published), 5));
  }
  for (const Slope& slope : kSlopes) {
    const json &plus = shots.at(slope.shot), &minus = shots.at(slope.shot + 1);
    const double step = (plus.at("inputs").at(slope.input).get<double>() -
                         minus.at("inputs").at(slope.input).get<double>()) /
                        slope.scale;
    const double published = plus.at("coefficients").at(slope.coefficient).get<double>() -
                             minus.at("coefficients").at(slope.coefficient).get<double>();
    const double ours = Coefficients(model.aircraft, plus.at("inputs"))[slope.coefficient] -
                        Coefficients(model.aircraft, minus.at("inputs"))[slope.coefficient];
    section.figures.push_back(PublishedOnce(slope.name, published / step, ours / step,
                                            model.ToleranceOf(published / step), 5));
  }
  return section;
}

/// Level flight at 45 deg of heading over 36 deg of latitude, the sum of gravity and of what a
/// rotating, round earth takes off it being Skein's gravity.
void AddTrimmedCase(const Model& model, const char* number, double altitude_ft, double speed_ft_s,
                    Section* section) {
  constexpr double kLatitudeDeg = 36.019167, kMassSlug = 637.1595;
  const json& check_case = CheckCases().at("cases").at(number);
  Aircraft f16 = model.aircraft;
  f16.airframe.cg = 0.25;
  f16.airframe.mass_slug = kMassSlug;
  const double each_way = speed_ft_s / std::sqrt(2);
  const Gravity gravity{
      GravityInLevelFlight(kLatitudeDeg / kDegPerRad, altitude_ft, each_way, each_way), false};
  const Plant plant(f16, AtmosphereModel::kStandard1976, 1, gravity);
  TrimRequest level;
  level.altitude_ft = altitude_ft;
  level.true_airspeed_ft_s = speed_ft_s;
  const TrimPoint trim = Trim(plant, level);
  const PlantOutput output = plant.Evaluate(trim.state, trim.controls);
  const double qbar_S = output.air.dynamic_pressure_psf * f16.airframe.wing_area_ft2;
  const auto add = [&](const char* what, const char* quantity, double skein, double tolerance,
                       int decimals) {
    section->figures.push_back(PublishedOften(std::string(what) + ", case " + number,
                                              Simulated(check_case, quantity, 0), skein, 0,
                                              tolerance, decimals));
  };
  add("pitch, deg", "pitch_deg", trim.pitch_rad * kDegPerRad, model.pitch_deg, 4);
  add("aerodynamic force along body z, lbf", "aero_z_lbf", qbar_S * output.coefficients[2],
      model.normal_lbf, 1);
  add("aerodynamic force along body x, lbf", "aero_x_lbf", qbar_S * output.coefficients[0],
      model.axial_lbf, 1);
}

Section TrimmedCases(const char* name, const Model& model) {
  Section section{name, "simulators", {}};
  AddTrimmedCase(model, "11", 10013, 400 * std::sqrt(2), &section);
  AddTrimmedCase(model, "12", 30013, 2000, &section);
  return section;
}

}  // namespace

std::vector<Section> PublishedF16Figures() {
  const Model book = BookModel(), report = ReportModel();
  return {TrimmedCases("cases-11-12", book), TrimmedCases("cases-11-12-tp1538", report),
          StaticShots("static-shots", book), StaticShots("static-shots-tp1538", report)};
}

}  // namespace skein::validation
