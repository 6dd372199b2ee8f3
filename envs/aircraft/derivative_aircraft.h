// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>

#include "envs/aircraft/aircraft.h"
#include "envs/aircraft/propulsion.h"

namespace skein {

/// Lift, drag and pitching moment. Coefficients are per radian, and per q chord / (2 V). Lift and
/// drag are those of Beard and McLain, Small Unmanned Aircraft, chapter 4:
///   CL(alpha) = (1 - s) (CL_0 + CL_alpha alpha) + s 2 sgn(alpha) sin^2(alpha) cos(alpha)
///   CD(alpha) = CD_parasitic + (CL_0 + CL_alpha alpha)^2 / (pi oswald_efficiency aspect ratio)
/// with s going from 0 to 1 about +-stall_alpha_rad, over some 4 / stall_sharpness rad.
struct LongitudinalDerivatives {
  double CL_0 = 0, CL_alpha = 0, CL_q = 0, CL_elevator = 0;
  double CD_parasitic = 0, CD_q = 0, CD_elevator = 0;
  double Cm_0 = 0, Cm_alpha = 0, Cm_q = 0, Cm_elevator = 0;
  double oswald_efficiency = 0;
  double stall_alpha_rad = 0, stall_sharpness = 0;
};

/// Side force, rolling and yawing moment in body axes, linear; per radian, and per p span / (2 V),
/// r span / (2 V). Ailerons are positive as books have them, rolling right: against Skein's sign.
struct LateralDerivatives {
  double CY_beta = 0, CY_p = 0, CY_r = 0, CY_aileron = 0, CY_rudder = 0;
  double Cl_beta = 0, Cl_p = 0, Cl_r = 0, Cl_aileron = 0, Cl_rudder = 0;
  double Cn_beta = 0, Cn_p = 0, Cn_r = 0, Cn_aileron = 0, Cn_rudder = 0;
};

/// What the structure and the handbook allow.
struct FlightLimits {
  double max_load_factor_g = 4, min_load_factor_g = -2;
  /// The highest speed and altitude; infinite where only thrust and its tables limit them.
  double max_speed_m_s = std::numeric_limits<double>::infinity();
  double max_altitude_m = std::numeric_limits<double>::infinity();
};

/// An aircraft as books on small aircraft print it, in SI units: mass, geometry, stability
/// derivatives, propulsion; and what Skein adds to fly it.
struct DerivativeAircraft {
  std::string name;
  double mass_kg = 0;
  double wing_area_m2 = 0, span_m = 0, chord_m = 0;
  double cg_chord_fraction = 0;  ///< where the derivatives were taken
  double Ixx_kg_m2 = 0, Iyy_kg_m2 = 0, Izz_kg_m2 = 0, Ixz_kg_m2 = 0;
  LongitudinalDerivatives longitudinal;
  LateralDerivatives lateral;
  Propulsion propulsion;
  ThrottleGearing throttle_gearing;
  PowerLag power_lag;
  double untrimmed_thrust_N = 0;
  Actuator elevator, aileron, rudder;
  FlightLimits limits;
  bool has_flight_control = true;  ///< false: flight_control is another aircraft's
  FlightControlGains flight_control;
  ReferenceUnits units;
};

double LiftCoefficient(const LongitudinalDerivatives& longitudinal, double alpha_rad);

/// `aspect_ratio` is span^2 / wing area.
double DragCoefficient(const LongitudinalDerivatives& longitudinal, double aspect_ratio,
                       double alpha_rad);

/// The aircraft in tables that every part of Skein flies: on alpha -25..50 deg (1.25 deg apart from
/// -5 to 30), sideslip +-30 deg and the elevator's range, all held beyond. What the derivatives
/// have linear stays exact but for the turn by alpha from wind to body axes, which like the stall
/// is linear between the nodes of alpha. There is no leading-edge flap: its increments are zero.
Aircraft MakeAircraft(const DerivativeAircraft& derivatives);

}  // namespace skein
