// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Core>
#include <cmath>
#include <functional>

#include "envs/aircraft/units.h"
#include "envs/reference/plant.h"
#include "envs/state/attitude.h"
#include "envs/state/state.h"
#include "tests/envs/aerosonde_model.h"
#include "tests/envs/validation/check_cases.h"
#include "tests/envs/validation/rotating_earth.h"
#include "tests/envs/validation/sections.h"

namespace skein::validation {
namespace {

using nlohmann::json;

constexpr double kStartFt = 30000;
constexpr double kStep_s = 0.02;

/// Gravity where all bodies fall.
Gravity FallingGravity() { return {EquatorialGravity(0), true}; }

/// A body without lift, drag and moments. The blend to a stalled wing lies beyond the tables.
DerivativeAircraft Body(double mass_slug) {
  DerivativeAircraft body = AerosondeModel();
  body.mass_kg = mass_slug * kKgPerSlug;
  body.longitudinal = {};
  body.longitudinal.oswald_efficiency = 1;
  body.longitudinal.stall_alpha_rad = 1.5;
  body.longitudinal.stall_sharpness = 100;
  body.lateral = {};
  return body;
}

/// The sphere's drag against the air that comes in its x-y plane, from any side but behind, with
/// nodes a degree apart: within 4e-5.
AerodynamicTables SphereTables(double drag_coefficient) {
  AerodynamicTables t;
  t.alpha_deg = t.alpha_lef_deg = t.elevator_deg = t.elevator_coarse_deg = {-1, 1};
  for (int beta = -90; beta <= 90; ++beta) t.beta_deg.push_back(beta);
  const std::size_t planes = t.alpha_deg.size() * t.beta_deg.size();
  for (auto* table : {&t.Cx, &t.Cz, &t.Cm, &t.Cn, &t.Cl}) table->assign(2 * planes, 0);
  for (auto* table : {&t.Cy, &t.Cy_r30, &t.Cn_r30, &t.Cl_r30, &t.Cy_a20, &t.Cn_a20, &t.Cl_a20,
                      &t.Cx_lef, &t.Cz_lef, &t.Cm_lef, &t.Cy_lef, &t.Cn_lef, &t.Cl_lef,
                      &t.Cy_a20_lef, &t.Cn_a20_lef, &t.Cl_a20_lef}) {
    table->assign(planes, 0);
  }
  for (std::size_t i = 0; i < planes; ++i) {
    const double beta = t.beta_deg[i % t.beta_deg.size()] / kDegPerRad;
    t.Cx[2 * i] = t.Cx[2 * i + 1] = t.Cx_lef[i] = -drag_coefficient * std::cos(beta);
    t.Cy[i] = t.Cy_r30[i] = t.Cy_a20[i] = t.Cy_lef[i] = t.Cy_a20_lef[i] =
        -drag_coefficient * std::sin(beta);
  }
  for (auto* table :
       {&t.Cxq,      &t.Czq,      &t.Cmq,      &t.Cyp,      &t.Cyr,      &t.Cnr,      &t.Cnp,
        &t.Clp,      &t.Clr,      &t.dCxq_lef, &t.dCzq_lef, &t.dCmq_lef, &t.dCyp_lef, &t.dCyr_lef,
        &t.dCnr_lef, &t.dCnp_lef, &t.dClp_lef, &t.dClr_lef, &t.dCn_beta, &t.dCl_beta, &t.dCm}) {
    table->assign(t.alpha_deg.size(), 0);
  }
  t.eta_el = {1, 1};
  return t;
}

Plant Sphere(bool has_drag) {
  const json& sphere = CheckCases().at("sphere");
  DerivativeAircraft body = Body(sphere.at("mass_slug").get<double>());
  body.wing_area_m2 = sphere.at("area_ft2").get<double>() * kMetresPerFoot * kMetresPerFoot;
  Aircraft aircraft = MakeAircraft(body);
  if (has_drag) aircraft.aerodynamics = SphereTables(sphere.at("CD").get<double>());
  return Plant(aircraft, AtmosphereModel::kStandard1976, 1, FallingGravity());
}

/// A fall over the flat earth, and what the rotating one adds to it.
struct Fall {
  RigidBodyState state;
  double t = 0;
  double more_down_fps = 0, east_fps = 0, higher_ft = 0;  ///< that the rotating earth adds
};

/// Velocity in north, east, down.
Eigen::Vector3d NedVelocity(const RigidBodyState& state) {
  return BodyFromNed(state.segment<4>(kQ0)).transpose() * state.segment<3>(kU);
}

/// One step. What the earth's rotation adds obeys the linear equations of small departures from
/// the fall: the difference of gravities, Coriolis' and the transport acceleration, and the drag's
/// answer to the departure.
void Advance(const Plant& plant, const Eigen::Vector3d& wind, Fall* fall) {
  const PlantOutput before = plant.Evaluate(fall->state, {}, wind);
  const double altitude = -fall->state[kDown];
  const Eigen::Vector3d velocity = NedVelocity(fall->state);
  fall->state = plant.StepRk4(fall->state, {}, kStep_s, wind);
  fall->t += kStep_s;

  const double down = (velocity.z() + NedVelocity(fall->state).z()) / 2;
  const double specific_force =
      kGravityFtS2 * Eigen::Vector3d(before.nx, before.ny, before.nz).norm();
  const double drag_per_s = specific_force / before.air.true_airspeed_ft_s;
  const double radius = wgs84::kEquatorialRadius_ft + altitude;
  const double turn = 2 * wgs84::kRotation_rad_s + fall->east_fps / radius;
  const double gravity = EquatorialGravity(altitude) - plant.gravity().At(altitude);
  const double east = velocity.y() + fall->east_fps;
  const double middle_down = fall->more_down_fps;
  fall->more_down_fps += kStep_s * (gravity - turn * east - 2 * drag_per_s * fall->more_down_fps);
  fall->east_fps += kStep_s * (turn * down - drag_per_s * fall->east_fps);
  fall->higher_ft -= kStep_s * (middle_down + fall->more_down_fps) / 2;
}

/// The attitude as roll, pitch, yaw, deg, relative to north, east and down of an earth that turned
/// by `turned_rad` about the north axis since the fall began: at the equator that is its own axis.
Eigen::Vector3d EulerDegrees(const RigidBodyState& state, double turned_rad) {
  const double c = std::cos(turned_rad), s = std::sin(turned_rad);
  Eigen::Matrix3d then_from_now;
  then_from_now << 1, 0, 0, 0, c, -s, 0, s, c;
  const Eigen::Matrix3d t = BodyFromNed(state.segment<4>(kQ0)) * then_from_now;
  return kDegPerRad * Eigen::Vector3d(std::atan2(t(1, 2), t(2, 2)), -std::asin(t(0, 2)),
                                      std::atan2(t(0, 1), t(0, 0)));
}

/// At rest at the altitude of all cases.
RigidBodyState Released(const EulerAngles& attitude) {
  RigidBodyState state = RigidBodyState::Zero();
  state[kDown] = -kStartFt;
  state.segment<4>(kQ0) = QuaternionFromEuler(attitude);
  return state;
}

struct CheckCase {
  const char* number;
  Plant plant;
  RigidBodyState start;
  /// Of the air, to the east, ft/s, by altitude.
  std::function<double(double)> wind_fps;
};

std::string At(const char* what, double t) {
  return std::string(what) + ", " + std::to_string(std::lround(t)) + " s";
}

void AddFall(const json& check_case, std::size_t index, const Fall& fall, Section* section) {
  // What the formulas leave out: the ellipsoid's curvature, and products of small quantities.
  constexpr double kSecondOrderFt = 2e-3, kSecondOrderFps = 2e-4;
  const Eigen::Vector3d velocity = NedVelocity(fall.state);
  section->figures.push_back(PublishedOften(At("altitude, ft", fall.t),
                                            Simulated(check_case, "altitude_ft", index),
                                            -fall.state[kDown], fall.higher_ft, kSecondOrderFt, 4));
  section->figures.push_back(PublishedOften(At("speed down, ft/s", fall.t),
                                            Simulated(check_case, "down_fps", index), velocity.z(),
                                            fall.more_down_fps, kSecondOrderFps, 5));
  section->figures.push_back(PublishedOften(At("speed east, ft/s", fall.t),
                                            Simulated(check_case, "east_fps", index), velocity.y(),
                                            fall.east_fps, kSecondOrderFps, 5));
}

void AddTumble(const json& check_case, std::size_t index, const Fall& fall, Section* section) {
  constexpr double kIntegrationDegPerS = 5e-5;  // other rules and steps
  constexpr double kLongitudeDeg = 1e-3;        // that the body gains on the earth below it
  const char* rates[] = {"p", "q", "r"};
  const char* angles[] = {"roll", "pitch", "yaw"};
  for (int k = 0; k < 3; ++k) {
    const std::string name = rates[k];
    section->figures.push_back(PublishedOften(
        At((name + ", deg/s").c_str(), fall.t), Simulated(check_case, name + "_deg_s", index),
        fall.state[kP + k] * kDegPerRad, 0, kIntegrationDegPerS, 5));
  }
  const Eigen::Vector3d flat = EulerDegrees(fall.state, 0);
  const Eigen::Vector3d rotating = EulerDegrees(fall.state, wgs84::kRotation_rad_s * fall.t);
  for (int k = 0; k < 3; ++k) {
    const std::string name = angles[k];
    section->figures.push_back(PublishedOften(At((name + ", deg").c_str(), fall.t),
                                              Simulated(check_case, name + "_deg", index), flat[k],
                                              rotating[k] - flat[k], kLongitudeDeg, 4));
  }
}

Section Fly(const char* name, const CheckCase& flown) {
  const json& check_case = CheckCases().at("cases").at(flown.number);
  Section section{name, "simulators", {}, "rotating earth"};
  Fall fall;
  fall.state = flown.start;
  const auto times = check_case.at("t_s").get<std::vector<double>>();
  for (std::size_t i = 0; i < times.size(); ++i) {
    while (fall.t < times[i] - kStep_s / 2) {
      Advance(flown.plant, {0, flown.wind_fps(-fall.state[kDown]), 0}, &fall);
    }
    AddFall(check_case, i, fall, &section);
    if (check_case.contains("p_deg_s")) AddTumble(check_case, i, fall, &section);
  }
  return section;
}

}  // namespace

Plant Brick(bool damped) {
  const json& brick = CheckCases().at("brick");
  const auto number = [&brick](const char* key) { return brick.at(key).get<double>(); };
  DerivativeAircraft body = Body(number("mass_slug"));
  body.Ixx_kg_m2 = number("Ixx_slug_ft2") * kKgM2PerSlugFt2;
  body.Iyy_kg_m2 = number("Iyy_slug_ft2") * kKgM2PerSlugFt2;
  body.Izz_kg_m2 = number("Izz_slug_ft2") * kKgM2PerSlugFt2;
  body.Ixz_kg_m2 = 0;
  body.wing_area_m2 = number("area_ft2") * kMetresPerFoot * kMetresPerFoot;
  body.span_m = number("span_ft") * kMetresPerFoot;
  body.chord_m = number("chord_ft") * kMetresPerFoot;
  if (damped) {
    body.lateral.Cl_p = number("Clp");
    body.longitudinal.Cm_q = number("Cmq");
    body.lateral.Cn_r = number("Cnr");
  }
  return Plant(MakeAircraft(body), AtmosphereModel::kStandard1976, 1, FallingGravity());
}

RigidBodyState FallingBrick() {
  RigidBodyState state = Released({});
  state.segment<3>(kP) = Eigen::Vector3d(10, 20, 30) / kDegPerRad;
  return state;
}

std::vector<Section> FallingBodies() {
  const auto calm = [](double) { return 0.0; };
  const auto steady = [](double) { return 20.0; };
  const auto shear = [](double altitude_ft) { return 0.003 * altitude_ft - 20; };
  const RigidBodyState level = Released({}), nose_down = Released({0, -90 / kDegPerRad, 0});
  return {Fly("case-01", {"01", Sphere(false), level, calm}),
          Fly("case-02", {"02", Brick(false), FallingBrick(), calm}),
          Fly("case-03", {"03", Brick(true), FallingBrick(), calm}),
          Fly("case-06", {"06", Sphere(true), nose_down, calm}),
          Fly("case-07", {"07", Sphere(true), nose_down, steady}),
          Fly("case-08", {"08", Sphere(true), nose_down, shear})};
}

}  // namespace skein::validation
