// SPDX-License-Identifier: Apache-2.0
#include "envs/aircraft/derivative_aircraft_file.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "envs/aircraft/aircraft_json.h"
#include "envs/aircraft/engine.h"

namespace skein {
namespace {

using nlohmann::json;

/// The sharpest stall whose blend, exponentials of it times angles up to 2.5 rad, stays finite.
constexpr double kSharpestStall = 250;
constexpr double kQuarterTurn_rad = 1.5707963267948966;

/// The straight lines from (0, 0) through the knee to (1, 100).
ThrottleGearing GearingThrough(double knee_throttle, double knee_power) {
  ThrottleGearing gearing;
  gearing.military_throttle = knee_throttle;
  gearing.dry_gain = knee_power / knee_throttle;
  gearing.afterburner_gain = (kMaximumPower - knee_power) / (1 - knee_throttle);
  gearing.afterburner_offset = kMaximumPower - gearing.afterburner_gain;
  return gearing;
}

/// A first-order lag, the same at every power.
PowerLag ConstantLag(double rate_per_s) {
  PowerLag lag;
  lag.rate_offset_per_s = lag.min_rate_per_s = lag.max_rate_per_s = rate_per_s;
  return lag;
}

void ReadAirframe(Section section, DerivativeAircraft* aircraft) {
  section.ReadPositive("mass_kg", &aircraft->mass_kg);
  section.ReadPositive("Ixx_kg_m2", &aircraft->Ixx_kg_m2);
  section.ReadPositive("Iyy_kg_m2", &aircraft->Iyy_kg_m2);
  section.ReadPositive("Izz_kg_m2", &aircraft->Izz_kg_m2);
  section.Read("Ixz_kg_m2", &aircraft->Ixz_kg_m2);
  section.ReadPositive("wing_area_m2", &aircraft->wing_area_m2);
  section.ReadPositive("span_m", &aircraft->span_m);
  section.ReadPositive("chord_m", &aircraft->chord_m);
  section.Read("cg_chord_fraction", &aircraft->cg_chord_fraction);
  section.Finish();
  if (aircraft->Ixz_kg_m2 * aircraft->Ixz_kg_m2 >= aircraft->Ixx_kg_m2 * aircraft->Izz_kg_m2) {
    section.Refuse("Ixz_kg_m2", aircraft->Ixz_kg_m2,
                   "smaller: its square below the product of Ixx_kg_m2 and Izz_kg_m2");
  }
}

void ReadLongitudinal(Section section, LongitudinalDerivatives* k) {
  section.Read("CL_0", &k->CL_0);
  section.Read("CL_alpha", &k->CL_alpha);
  section.Read("CL_q", &k->CL_q);
  section.Read("CL_elevator", &k->CL_elevator);
  section.Read("CD_parasitic", &k->CD_parasitic);
  section.Read("CD_q", &k->CD_q);
  section.Read("CD_elevator", &k->CD_elevator);
  section.Read("Cm_0", &k->Cm_0);
  section.Read("Cm_alpha", &k->Cm_alpha);
  section.Read("Cm_q", &k->Cm_q);
  section.Read("Cm_elevator", &k->Cm_elevator);
  section.ReadPositive("oswald_efficiency", &k->oswald_efficiency);
  section.ReadBetween(0, kQuarterTurn_rad, "stall_alpha_rad", &k->stall_alpha_rad);
  section.ReadBetween(0, kSharpestStall, "stall_sharpness", &k->stall_sharpness);
  section.Finish();
}

void ReadLateral(Section section, LateralDerivatives* k) {
  section.Read("CY_beta", &k->CY_beta);
  section.Read("CY_p", &k->CY_p);
  section.Read("CY_r", &k->CY_r);
  section.Read("CY_aileron", &k->CY_aileron);
  section.Read("CY_rudder", &k->CY_rudder);
  section.Read("Cl_beta", &k->Cl_beta);
  section.Read("Cl_p", &k->Cl_p);
  section.Read("Cl_r", &k->Cl_r);
  section.Read("Cl_aileron", &k->Cl_aileron);
  section.Read("Cl_rudder", &k->Cl_rudder);
  section.Read("Cn_beta", &k->Cn_beta);
  section.Read("Cn_p", &k->Cn_p);
  section.Read("Cn_r", &k->Cn_r);
  section.Read("Cn_aileron", &k->Cn_aileron);
  section.Read("Cn_rudder", &k->Cn_rudder);
  section.Finish();
}

void ReadPropulsion(Section section, DerivativeAircraft* aircraft) {
  Propeller& propeller = aircraft->propeller;
  section.ReadPositive("diameter_m", &propeller.diameter_m);
  section.Read("CT_0", &propeller.CT_0);
  section.Read("CT_1", &propeller.CT_1);
  section.Read("CT_2", &propeller.CT_2);
  section.ReadPositive("CQ_0", &propeller.CQ_0);
  section.Read("CQ_1", &propeller.CQ_1);
  section.Read("CQ_2", &propeller.CQ_2);
  section.ReadPositive("speed_constant_rpm_per_V", &propeller.speed_constant_rpm_per_V);
  section.ReadPositive("resistance_ohm", &propeller.resistance_ohm);
  section.Read("no_load_current_A", &propeller.no_load_current_A);
  section.ReadPositive("max_voltage_V", &propeller.max_voltage_V);

  Section levels = section.Below("motor_throttle");
  PropellerLevels& level = aircraft->propeller_levels;
  levels.Read("idle", &level.idle);
  levels.Read("military", &level.military);
  levels.Read("maximum", &level.maximum);
  levels.Finish();
  if (!(level.idle >= 0)) levels.Refuse("idle", level.idle, "zero or more");
  if (!(level.military > level.idle)) levels.Refuse("military", level.military, "above idle");
  if (!(level.maximum > level.military)) {
    levels.Refuse("maximum", level.maximum, "above military");
  }
  if (!(level.maximum <= 1)) levels.Refuse("maximum", level.maximum, "at most 1");
  // The motor's speed is the root of a quadratic, which there must be.
  const EngineTables tables = TabulatePropeller(propeller, level);
  for (const auto* thrusts : {&tables.idle_lbf, &tables.military_lbf, &tables.maximum_lbf}) {
    for (const double thrust : *thrusts) {
      if (!std::isfinite(thrust)) {
        section.Refuse("CQ_2", propeller.CQ_2,
                       "smaller: at no speed would the motor turn the propeller");
      }
    }
  }

  Section gearing = section.Below("throttle_gearing");
  double knee_throttle = 0, knee_power = 0;
  gearing.ReadBetween(0, 1, "knee_throttle", &knee_throttle);
  gearing.ReadBetween(0, kMaximumPower, "knee_power", &knee_power);
  gearing.Finish();
  aircraft->throttle_gearing = GearingThrough(knee_throttle, knee_power);

  double rate_per_s = 0;
  section.ReadPositive("power_rate_per_s", &rate_per_s);
  aircraft->power_lag = ConstantLag(rate_per_s);
  section.Read("untrimmed_thrust_N", &aircraft->untrimmed_thrust_N);
  section.Finish();
}

void ReadFlightControl(Section section, FlightControlGains* g) {
  section.Read("alpha_min_deg", &g->alpha_min_deg);
  section.Read("alpha_max_deg", &g->alpha_max_deg);
  section.Read("alpha_filter", &g->alpha_filter);
  section.ReadPositive("pitch_gain_pressure_psf", &g->pitch_gain_pressure_psf);
  section.ReadPositive("roll_gain_pressure_psf", &g->roll_gain_pressure_psf);
  section.ReadPositive("yaw_gain_pressure_psf", &g->yaw_gain_pressure_psf);
  section.Read("max_load_factor_command", &g->max_load_factor_command);
  section.Read("max_load_factor_reduction", &g->max_load_factor_reduction);
  section.Read("min_load_factor_relative_reduction", &g->min_load_factor_relative_reduction);
  section.Read("min_load_factor_command", &g->min_load_factor_command);

  section.Read("pitch_rate_filter", &g->pitch_rate_filter);
  section.Read("pitch_rate_washout", &g->pitch_rate_washout);
  section.Read("load_factor_filter", &g->load_factor_filter);
  section.Read("load_factor_command_filter", &g->load_factor_command_filter);
  section.Read("pitch_lead", &g->pitch_lead);
  section.Read("pitch_proportional_deg_per_g", &g->pitch_proportional_deg_per_g);
  section.Read("pitch_integral_per_s", &g->pitch_integral_per_s);
  section.Read("pitch_rate_gain_g_s_per_deg", &g->pitch_rate_gain_g_s_per_deg);
  section.Read("alpha_to_elevator", &g->alpha_to_elevator);
  section.Read("limiter_rate_lead_s", &g->limiter_rate_lead_s);
  section.Read("limiter_rate_fade", &g->limiter_rate_fade);
  section.Read("alpha_onset_deg", &g->alpha_onset_deg);
  section.Read("alpha_onset_gain_g_per_deg", &g->alpha_onset_gain_g_per_deg);
  section.Read("alpha_limit_deg", &g->alpha_limit_deg);
  section.Read("alpha_limit_gain_g_per_deg", &g->alpha_limit_gain_g_per_deg);
  section.Read("pitch_integrator_limit_deg", &g->pitch_integrator_limit_deg);

  section.Read("roll_rate_filter", &g->roll_rate_filter);
  section.Read("roll_command_filter", &g->roll_command_filter);
  section.Read("max_roll_rate_deg_s", &g->max_roll_rate_deg_s);
  section.Read("roll_rate_fade", &g->roll_rate_fade);
  section.Read("roll_rate_gain_s", &g->roll_rate_gain_s);
  section.Read("roll_integral_per_s", &g->roll_integral_per_s);
  section.Read("roll_integrator_fade", &g->roll_integrator_fade);
  section.Read("roll_integrator_gate", &g->roll_integrator_gate);
  section.Read("roll_integrator_antiwindup_per_s", &g->roll_integrator_antiwindup_per_s);
  section.Read("roll_integrator_leak_per_s", &g->roll_integrator_leak_per_s);
  section.Read("roll_integrator_limit_deg", &g->roll_integrator_limit_deg);

  section.Read("yaw_rate_filter", &g->yaw_rate_filter);
  section.Read("yaw_washout", &g->yaw_washout);
  section.Read("yaw_lead", &g->yaw_lead);
  section.Read("pedal_filter", &g->pedal_filter);
  section.Read("lateral_acceleration_filter", &g->lateral_acceleration_filter);
  section.Read("max_pedal_rudder_deg", &g->max_pedal_rudder_deg);
  section.Read("pedal_fade", &g->pedal_fade);
  section.Read("yaw_rate_gain_s", &g->yaw_rate_gain_s);
  section.Read("lateral_acceleration_gain_deg_per_g", &g->lateral_acceleration_gain_deg_per_g);
  section.Read("aileron_rudder_interconnect_per_deg", &g->aileron_rudder_interconnect_per_deg);
  section.Read("interconnect_min", &g->interconnect_min);
  section.Read("interconnect_max", &g->interconnect_max);
  section.Finish();
}

void ReadUnits(Section section, DerivativeAircraft* aircraft) {
  section.ReadPositive("altitude_error_m", &aircraft->altitude_error_unit_m);
  section.ReadPositive("altitude_m", &aircraft->altitude_unit_m);
  section.ReadPositive("speed_m_s", &aircraft->speed_unit_m_s);
  section.Finish();
}

}  // namespace

DerivativeAircraft ReadDerivativeAircraft(const std::string& name, std::string_view text) {
  const std::string where = "aircraft " + name;
  const json file = ParseAircraftJson(text, where);
  Section section(file, where);
  for (const char* key : kNotOfTheModel) section.Skip(key);
  DerivativeAircraft aircraft;
  aircraft.name = name;
  ReadAirframe(section.Below("airframe"), &aircraft);
  ReadLongitudinal(section.Below("longitudinal"), &aircraft.longitudinal);
  ReadLateral(section.Below("lateral"), &aircraft.lateral);
  ReadPropulsion(section.Below("propulsion"), &aircraft);
  Section actuators = section.Below("actuators");
  actuators.Read("elevator", &aircraft.elevator);
  actuators.Read("aileron", &aircraft.aileron);
  actuators.Read("rudder", &aircraft.rudder);
  actuators.Finish();
  ReadFlightControl(section.Below("flight_control"), &aircraft.flight_control);
  ReadUnits(section.Below("observation_units"), &aircraft);
  section.Finish();
  return aircraft;
}

}  // namespace skein
