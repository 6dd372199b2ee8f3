// SPDX-License-Identifier: Apache-2.0
// Case 13 of NASA/TM-2015-218675 without its control law, which is not published with the results:
// the flights that it ends in, and the forces on the way there.
#include <Eigen/Core>
#include <cmath>
#include <string>

#include "envs/reference/aerodynamics.h"
#include "envs/reference/trim.h"
#include "envs/state/attitude.h"
#include "envs/state/state.h"
#include "tests/envs/validation/book_f16.h"
#include "tests/envs/validation/check_cases.h"
#include "tests/envs/validation/rotating_earth.h"
#include "tests/envs/validation/sections.h"

namespace skein::validation {
namespace {

using nlohmann::json;

/// How a simulator's aircraft moves at a time: altitude [ft], velocity north, east, down [ft/s],
/// roll, pitch, yaw [deg] and p, q, r [deg/s].
struct Motion {
  explicit Motion(const json& numbers) {
    const auto number = [&numbers](int i) { return numbers.at(i).get<double>(); };
    altitude_ft = number(0);
    velocity_ft_s << number(1), number(2), number(3);
    attitude = {number(4) / kDegPerRad, number(5) / kDegPerRad, number(6) / kDegPerRad};
    rates_rad_s = Eigen::Vector3d(number(7), number(8), number(9)) / kDegPerRad;
  }
  double altitude_ft;
  Eigen::Vector3d velocity_ft_s;
  EulerAngles attitude;
  Eigen::Vector3d rates_rad_s;
};

/// The book's F-16 as case 11 loads it.
Aircraft LoadedF16() {
  Aircraft f16 = BookF16();
  f16.airframe.cg = 0.25;
  f16.airframe.mass_slug = 637.1595;
  return f16;
}

/// Level flight as fast, as high and on the course that the simulator is in at the end.
void AddEnd(const json& end, Section* section) {
  constexpr double kPitchDeg = 5e-4, kForceLbf = 0.2;  // as of cases 11 and 12
  const Motion motion(end.at("motion"));
  const Gravity gravity{
      GravityInLevelFlight(end.at("latitude_deg").get<double>() / kDegPerRad, motion.altitude_ft,
                           motion.velocity_ft_s.x(), motion.velocity_ft_s.y()),
      false};
  const Plant plant(LoadedF16(), AtmosphereModel::kStandard1976, 1, gravity);
  TrimRequest level;
  level.altitude_ft = motion.altitude_ft;
  level.true_airspeed_ft_s = motion.velocity_ft_s.norm();
  const TrimPoint trim = Trim(plant, level);
  const PlantOutput output = plant.Evaluate(trim.state, trim.controls);
  const double qbar_S = output.air.dynamic_pressure_psf * plant.aircraft().airframe.wing_area_ft2;
  const auto add = [&](const char* what, double published, double skein, double tolerance,
                       int decimals) {
    section->figures.push_back(
        PublishedOnce(std::string(what) + ", " + end.at("case").get<std::string>(), published,
                      skein, tolerance, decimals));
  };
  add("pitch, deg", motion.attitude.pitch * kDegPerRad, trim.pitch_rad * kDegPerRad, kPitchDeg, 4);
  add("aerodynamic force along body x, lbf", end.at("aero").at(0).get<double>(),
      qbar_S * output.coefficients[0], kForceLbf, 1);
  add("aerodynamic force along body z, lbf", end.at("aero").at(1).get<double>(),
      qbar_S * output.coefficients[2], kForceLbf, 1);
}

Section Ends() {
  Section section{"case-13-ends", "simulator", {}};
  for (const json& end : CheckCases().at("ends")) AddEnd(end, &section);
  return section;
}

/// How north, east and down turn against the inertial frame, rad/s, where the manoeuvres are flown:
/// with the earth, and around it.
Eigen::Vector3d RateOfNed(const Motion& motion) {
  constexpr double kLatitude = 36.02 / kDegPerRad;
  const double radius_ft = wgs84::kEquatorialRadius_ft + motion.altitude_ft;
  const double north = motion.velocity_ft_s.x() / radius_ft;
  const double east = motion.velocity_ft_s.y() / radius_ft;
  return wgs84::kRotation_rad_s * Eigen::Vector3d(std::cos(kLatitude), 0, -std::sin(kLatitude)) +
         Eigen::Vector3d(east, -north, -east * std::tan(kLatitude));
}

/// Forces along body x and z, lbf, of the book's F-16 in a simulator's motion with the elevator
/// that gives its pitching moment about the centre of gravity [lbf ft].
Eigen::Vector2d ForcesIn(const Motion& motion, double pitching_moment) {
  const Plant plant(LoadedF16(), AtmosphereModel::kStandard1976);
  RigidBodyState state = RigidBodyState::Zero();
  state[kDown] = -motion.altitude_ft;
  state.segment<4>(kQ0) = QuaternionFromEuler(motion.attitude);
  const Eigen::Matrix3d body_from_ned = BodyFromNed(state.segment<4>(kQ0));
  state.segment<3>(kU) = body_from_ned * motion.velocity_ft_s;
  state.segment<3>(kP) = motion.rates_rad_s - body_from_ned * RateOfNed(motion);
  const Airframe& airframe = plant.aircraft().airframe;
  Controls controls;
  PlantOutput output;
  // Trailing edge down is nose down.
  double up_deg = -25, down_deg = 25;
  for (int i = 0; i < 60; ++i) {
    controls.elevator_deg = (up_deg + down_deg) / 2;
    output = plant.Evaluate(state, controls);
    const double moment = output.coefficients[4] * output.air.dynamic_pressure_psf *
                          airframe.wing_area_ft2 * airframe.chord_ft;
    (moment > pitching_moment ? up_deg : down_deg) = controls.elevator_deg;
  }
  const double qbar_S = output.air.dynamic_pressure_psf * airframe.wing_area_ft2;
  return qbar_S * Eigen::Vector2d(output.coefficients[0], output.coefficients[2]);
}

Section OnTheWay() {
  constexpr double kForceLbf = 3;  // a ten-thousandth of the greatest
  Section section{"case-13-forces", "simulator", {}};
  for (const json& at : CheckCases().at("manoeuvres")) {
    const json& aero = at.at("aero");
    const auto published = [&aero](int i) { return aero.at(i).get<double>(); };
    const Eigen::Vector2d forces = ForcesIn(Motion(at.at("motion")), published(2));
    const std::string when = ", " + at.at("case").get<std::string>() + ", " +
                             std::to_string(at.at("t_s").get<int>()) + " s, simulator " +
                             at.at("simulator").get<std::string>();
    section.figures.push_back(
        PublishedOnce("force along body x, lbf" + when, published(0), forces[0], kForceLbf, 1));
    section.figures.push_back(
        PublishedOnce("force along body z, lbf" + when, published(1), forces[1], kForceLbf, 1));
  }
  return section;
}

}  // namespace

std::vector<Section> PublishedManoeuvres() { return {Ends(), OnTheWay()}; }

}  // namespace skein::validation
