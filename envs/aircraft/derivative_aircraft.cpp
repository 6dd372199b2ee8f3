// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/derivative_aircraft.h"

#include <cmath>

#include "envs/aircraft/aircraft_sections.h"
#include "envs/aircraft/units.h"

namespace skein {
namespace {

constexpr double kPi = 3.141592653589793238;

// The kernels hold 32 cells of alpha, of one width inside and one outside.
constexpr double kAlphaLowDeg = -25, kAlphaHighDeg = 50, kOuterCellDeg = 10;
constexpr double kInnerLowDeg = -5, kInnerHighDeg = 30, kInnerCellDeg = 1.25;
constexpr double kMaxBetaDeg = 30;

std::vector<double> AlphaNodes() {
  std::vector<double> nodes;
  const auto add = [&nodes](double from, double to, double width) {
    for (double node = from; node < to; node += width) nodes.push_back(node);
  };
  add(kAlphaLowDeg, kInnerLowDeg, kOuterCellDeg);
  add(kInnerLowDeg, kInnerHighDeg, kInnerCellDeg);
  add(kInnerHighDeg, kAlphaHighDeg, kOuterCellDeg);
  nodes.push_back(kAlphaHighDeg);
  return nodes;
}

/// Forces along the body's x and z from drag and lift.
struct BodyForces {
  double Cx, Cz;
};

BodyForces ToBody(double CD, double CL, double alpha_rad) {
  const double cosine = std::cos(alpha_rad), sine = std::sin(alpha_rad);
  return {CL * sine - CD * cosine, -CD * sine - CL * cosine};
}

void FillLongitudinal(const DerivativeAircraft& aircraft, AerodynamicTables* t) {
  const LongitudinalDerivatives& k = aircraft.longitudinal;
  const double aspect_ratio = aircraft.span_m * aircraft.span_m / aircraft.wing_area_m2;
  for (const double alpha_deg : t->alpha_deg) {
    const double alpha = alpha_deg / kDegPerRad;
    const double CL = LiftCoefficient(k, alpha), CD = DragCoefficient(k, aspect_ratio, alpha);
    const double Cm = k.Cm_0 + k.Cm_alpha * alpha;
    const BodyForces clean = ToBody(CD, CL, alpha);
    for (std::size_t j = 0; j < t->beta_deg.size(); ++j) {
      for (const double elevator_deg : t->elevator_deg) {
        const double elevator = elevator_deg / kDegPerRad;
        const BodyForces force =
            ToBody(CD + k.CD_elevator * elevator, CL + k.CL_elevator * elevator, alpha);
        t->Cx.push_back(force.Cx);
        t->Cz.push_back(force.Cz);
        t->Cm.push_back(Cm + k.Cm_elevator * elevator);
      }
      t->Cx_lef.push_back(clean.Cx);
      t->Cz_lef.push_back(clean.Cz);
      t->Cm_lef.push_back(Cm);
    }
    const BodyForces damping = ToBody(k.CD_q, k.CL_q, alpha);
    t->Cxq.push_back(damping.Cx);
    t->Czq.push_back(damping.Cz);
    t->Cmq.push_back(k.Cm_q);
  }
}

void FillLateral(const DerivativeAircraft& aircraft, const Airframe& airframe,
                 AerodynamicTables* t) {
  const LateralDerivatives& k = aircraft.lateral;
  const double aileron = -airframe.aileron_reference_deg / kDegPerRad;  // of the books' sign
  const double rudder = airframe.rudder_reference_deg / kDegPerRad;
  for (std::size_t i = 0; i < t->alpha_deg.size(); ++i) {
    for (const double beta_deg : t->beta_deg) {
      const double beta = beta_deg / kDegPerRad;
      const double CY = k.CY_beta * beta, Cl = k.Cl_beta * beta, Cn = k.Cn_beta * beta;
      for (std::size_t e = 0; e < t->elevator_coarse_deg.size(); ++e) {
        t->Cl.push_back(Cl);
        t->Cn.push_back(Cn);
      }
      t->Cy.push_back(CY);
      t->Cy_a20.push_back(CY + k.CY_aileron * aileron);
      t->Cl_a20.push_back(Cl + k.Cl_aileron * aileron);
      t->Cn_a20.push_back(Cn + k.Cn_aileron * aileron);
      t->Cy_r30.push_back(CY + k.CY_rudder * rudder);
      t->Cl_r30.push_back(Cl + k.Cl_rudder * rudder);
      t->Cn_r30.push_back(Cn + k.Cn_rudder * rudder);
      t->Cy_lef.push_back(CY);
      t->Cl_lef.push_back(Cl);
      t->Cn_lef.push_back(Cn);
    }
  }
  t->Cy_a20_lef = t->Cy_a20;
  t->Cl_a20_lef = t->Cl_a20;
  t->Cn_a20_lef = t->Cn_a20;
  const auto constant = [t](double value) {
    return std::vector<double>(t->alpha_deg.size(), value);
  };
  t->Cyp = constant(k.CY_p);
  t->Cyr = constant(k.CY_r);
  t->Clp = constant(k.Cl_p);
  t->Clr = constant(k.Cl_r);
  t->Cnp = constant(k.Cn_p);
  t->Cnr = constant(k.Cn_r);
}

AerodynamicTables Tabulate(const DerivativeAircraft& aircraft, const Airframe& airframe) {
  AerodynamicTables t;
  t.alpha_deg = AlphaNodes();
  t.alpha_lef_deg = t.alpha_deg;
  t.beta_deg = {-kMaxBetaDeg, kMaxBetaDeg};
  // With a node at zero, the increments of a flap that is not there are zero to the last bit.
  t.elevator_deg = {aircraft.elevator.min_deg, 0, aircraft.elevator.max_deg};
  t.elevator_coarse_deg = t.elevator_deg;
  FillLongitudinal(aircraft, &t);
  FillLateral(aircraft, airframe, &t);
  const std::vector<double> zero(t.alpha_deg.size(), 0.0);
  for (auto* table : {&t.dCxq_lef, &t.dCzq_lef, &t.dCmq_lef, &t.dCyp_lef, &t.dCyr_lef, &t.dCnr_lef,
                      &t.dCnp_lef, &t.dClp_lef, &t.dClr_lef, &t.dCn_beta, &t.dCl_beta, &t.dCm}) {
    *table = zero;
  }
  t.eta_el.assign(t.elevator_deg.size(), 1.0);
  return t;
}

Airframe MakeAirframe(const DerivativeAircraft& aircraft) {
  Airframe airframe;
  airframe.mass_slug = aircraft.mass_kg / kKgPerSlug;
  airframe.wing_area_ft2 = aircraft.wing_area_m2 * kFeetPerMetre * kFeetPerMetre;
  airframe.span_ft = aircraft.span_m * kFeetPerMetre;
  airframe.chord_ft = aircraft.chord_m * kFeetPerMetre;
  airframe.cg_reference = aircraft.cg_chord_fraction;
  airframe.cg = aircraft.cg_chord_fraction;
  airframe.Ixx = aircraft.Ixx_kg_m2 / kKgM2PerSlugFt2;
  airframe.Iyy = aircraft.Iyy_kg_m2 / kKgM2PerSlugFt2;
  airframe.Izz = aircraft.Izz_kg_m2 / kKgM2PerSlugFt2;
  airframe.Ixz = aircraft.Ixz_kg_m2 / kKgM2PerSlugFt2;
  airframe.aileron_reference_deg = aircraft.aileron.max_deg;
  airframe.rudder_reference_deg = aircraft.rudder.max_deg;
  return airframe;
}

}  // namespace

double LiftCoefficient(const LongitudinalDerivatives& longitudinal, double alpha_rad) {
  const double rising =
      std::exp(-longitudinal.stall_sharpness * (alpha_rad - longitudinal.stall_alpha_rad));
  const double falling =
      std::exp(longitudinal.stall_sharpness * (alpha_rad + longitudinal.stall_alpha_rad));
  const double stalled = (1 + rising + falling) / ((1 + rising) * (1 + falling));
  const double sine = std::sin(alpha_rad);
  const double plate = 2 * std::copysign(sine * sine, alpha_rad) * std::cos(alpha_rad);
  const double attached = longitudinal.CL_0 + longitudinal.CL_alpha * alpha_rad;
  return (1 - stalled) * attached + stalled * plate;
}

double DragCoefficient(const LongitudinalDerivatives& longitudinal, double aspect_ratio,
                       double alpha_rad) {
  const double attached = longitudinal.CL_0 + longitudinal.CL_alpha * alpha_rad;
  return longitudinal.CD_parasitic +
         attached * attached / (kPi * longitudinal.oswald_efficiency * aspect_ratio);
}

Aircraft MakeAircraft(const DerivativeAircraft& derivatives) {
  Aircraft aircraft;
  aircraft.name = derivatives.name;
  aircraft.airframe = MakeAirframe(derivatives);
  aircraft.aerodynamics = Tabulate(derivatives, aircraft.airframe);
  aircraft.engine = TabulateThrust(derivatives.propulsion);
  aircraft.throttle_gearing = derivatives.throttle_gearing;
  aircraft.power_lag = derivatives.power_lag;
  aircraft.actuators = {derivatives.elevator, derivatives.aileron, derivatives.rudder, {}};
  aircraft.flight_control = derivatives.flight_control;
  LeaveOutFlap(&aircraft);
  aircraft.units = derivatives.units;
  aircraft.untrimmed_thrust_lbf = derivatives.untrimmed_thrust_N / kNewtonsPerLbf;
  return aircraft;
}

}  // namespace skein
