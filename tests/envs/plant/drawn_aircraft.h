// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "envs/aircraft/aircraft.h"
#include "envs/plant/plant_draw.h"

namespace skein {

/// The drawn plant as an aircraft of its own, in double precision: its data are other ones, and
/// what reads them (envs/reference) knows of no draws. Left out are stick gains, delays, sensors,
/// and the air's density, which belongs to the air.
inline Aircraft DrawnAircraft(const Aircraft& nominal, const PlantDraw& draw) {
  using Values = std::vector<double>;
  const auto scale = [](double factor, const std::vector<Values*>& tables) {
    for (Values* table : tables) {
      for (double& value : *table) value *= factor;
    }
  };
  Aircraft aircraft = nominal;
  Airframe& airframe = aircraft.airframe;
  airframe.mass_slug *= draw.mass;
  for (double* inertia : {&airframe.Ixx, &airframe.Iyy, &airframe.Izz, &airframe.Ixz}) {
    *inertia *= draw.inertia;
  }
  airframe.cg += draw.cg_shift;
  airframe.engine_angular_momentum += draw.engine_momentum;

  AerodynamicTables& t = aircraft.aerodynamics;
  scale(draw.axial_force, {&t.Cx, &t.Cx_lef});
  scale(draw.normal_force, {&t.Cz, &t.Cz_lef});
  scale(draw.pitching_moment, {&t.Cm, &t.Cm_lef, &t.dCm});
  scale(draw.lateral, {&t.Cy, &t.Cn, &t.Cl, &t.Cy_lef, &t.Cn_lef, &t.Cl_lef, &t.Cy_r30, &t.Cn_r30,
                       &t.Cl_r30, &t.Cy_a20, &t.Cn_a20, &t.Cl_a20, &t.Cy_a20_lef, &t.Cn_a20_lef,
                       &t.Cl_a20_lef, &t.dCn_beta, &t.dCl_beta});
  scale(draw.damping, {&t.Cxq, &t.Czq, &t.Cmq, &t.Cyp, &t.Cyr, &t.Cnr, &t.Cnp, &t.Clp, &t.Clr,
                       &t.dCxq_lef, &t.dCzq_lef, &t.dCmq_lef, &t.dCyp_lef, &t.dCyr_lef, &t.dCnr_lef,
                       &t.dCnp_lef, &t.dClp_lef, &t.dClr_lef});
  // Surfaces whose deflections act as others: the tables meet them elsewhere on their axes. The
  // increments by aileron and rudder have been scaled with the rest of the lateral tables.
  scale(1 / draw.elevator, {&t.elevator_deg, &t.elevator_coarse_deg});
  airframe.aileron_reference_deg *= draw.lateral / draw.aileron;
  airframe.rudder_reference_deg *= draw.lateral / draw.rudder;

  EngineTables& engine = aircraft.engine;
  scale(draw.thrust, {&engine.idle_lbf, &engine.military_lbf, &engine.maximum_lbf});
  PowerLag& lag = aircraft.power_lag;
  for (double* rate : {&lag.max_rate_per_s, &lag.min_rate_per_s, &lag.rate_offset_per_s,
                       &lag.rate_slope_per_s, &lag.afterburner_rate_per_s}) {
    *rate /= draw.thrust_lag;
  }
  Actuators& actuators = aircraft.actuators;
  for (Actuator* actuator :
       {&actuators.elevator, &actuators.aileron, &actuators.rudder, &actuators.leading_edge_flap}) {
    actuator->bandwidth_per_s *= draw.actuator_bandwidth;
    actuator->rate_limit_deg_per_s *= draw.actuator_rate;
  }
  return aircraft;
}

}  // namespace skein
