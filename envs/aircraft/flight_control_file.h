// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/aircraft/aircraft_json.h"
#include "envs/aircraft/flight_control_gains.h"

namespace skein {

/// Calls visit(name, &value) for every gain that an aircraft's file has, in its order: all but the
/// leading-edge flap's. Values are double, FirstOrder or Ramp. `gains` is FlightControlGains, const
/// or not.
template <class Gains, class Visit>
void VisitPitchGains(Gains& gains, const Visit& visit) {
  visit("alpha_min_deg", &gains.alpha_min_deg);
  visit("alpha_max_deg", &gains.alpha_max_deg);
  visit("alpha_filter", &gains.alpha_filter);
  visit("pitch_gain_pressure_psf", &gains.pitch_gain_pressure_psf);
  visit("roll_gain_pressure_psf", &gains.roll_gain_pressure_psf);
  visit("yaw_gain_pressure_psf", &gains.yaw_gain_pressure_psf);
  visit("max_load_factor_command", &gains.max_load_factor_command);
  visit("max_load_factor_reduction", &gains.max_load_factor_reduction);
  visit("min_load_factor_relative_reduction", &gains.min_load_factor_relative_reduction);
  visit("min_load_factor_command", &gains.min_load_factor_command);

  visit("pitch_rate_filter", &gains.pitch_rate_filter);
  visit("pitch_rate_washout", &gains.pitch_rate_washout);
  visit("load_factor_filter", &gains.load_factor_filter);
  visit("load_factor_command_filter", &gains.load_factor_command_filter);
  visit("pitch_lead", &gains.pitch_lead);
  visit("pitch_proportional_deg_per_g", &gains.pitch_proportional_deg_per_g);
  visit("pitch_integral_per_s", &gains.pitch_integral_per_s);
  visit("pitch_rate_gain_g_s_per_deg", &gains.pitch_rate_gain_g_s_per_deg);
  visit("alpha_to_elevator", &gains.alpha_to_elevator);
  visit("limiter_rate_lead_s", &gains.limiter_rate_lead_s);
  visit("limiter_rate_fade", &gains.limiter_rate_fade);
  visit("alpha_onset_deg", &gains.alpha_onset_deg);
  visit("alpha_onset_gain_g_per_deg", &gains.alpha_onset_gain_g_per_deg);
  visit("alpha_limit_deg", &gains.alpha_limit_deg);
  visit("alpha_limit_gain_g_per_deg", &gains.alpha_limit_gain_g_per_deg);
  visit("pitch_integrator_limit_deg", &gains.pitch_integrator_limit_deg);
}
template <class Gains, class Visit>
void VisitRollGains(Gains& gains, const Visit& visit) {
  visit("roll_rate_filter", &gains.roll_rate_filter);
  visit("roll_command_filter", &gains.roll_command_filter);
  visit("max_roll_rate_deg_s", &gains.max_roll_rate_deg_s);
  visit("roll_rate_fade", &gains.roll_rate_fade);
  visit("roll_rate_gain_s", &gains.roll_rate_gain_s);
  visit("roll_integral_per_s", &gains.roll_integral_per_s);
  visit("roll_integrator_fade", &gains.roll_integrator_fade);
  visit("roll_integrator_gate", &gains.roll_integrator_gate);
  visit("roll_integrator_antiwindup_per_s", &gains.roll_integrator_antiwindup_per_s);
  visit("roll_integrator_leak_per_s", &gains.roll_integrator_leak_per_s);
  visit("roll_integrator_limit_deg", &gains.roll_integrator_limit_deg);
}
template <class Gains, class Visit>
void VisitYawGains(Gains& gains, const Visit& visit) {
  visit("yaw_rate_filter", &gains.yaw_rate_filter);
  visit("yaw_washout", &gains.yaw_washout);
  visit("yaw_lead", &gains.yaw_lead);
  visit("pedal_filter", &gains.pedal_filter);
  visit("lateral_acceleration_filter", &gains.lateral_acceleration_filter);
  visit("max_pedal_rudder_deg", &gains.max_pedal_rudder_deg);
  visit("pedal_fade", &gains.pedal_fade);
  visit("yaw_rate_gain_s", &gains.yaw_rate_gain_s);
  visit("lateral_acceleration_gain_deg_per_g", &gains.lateral_acceleration_gain_deg_per_g);
  visit("aileron_rudder_interconnect_per_deg", &gains.aileron_rudder_interconnect_per_deg);
  visit("interconnect_min", &gains.interconnect_min);
  visit("interconnect_max", &gains.interconnect_max);
}
template <class Gains, class Visit>
void VisitFlightControlGains(Gains& gains, const Visit& visit) {
  VisitPitchGains(gains, visit);
  VisitRollGains(gains, visit);
  VisitYawGains(gains, visit);
}

/// The same of the leading-edge flap's gains.
template <class Gains, class Visit>
void VisitFlapGains(Gains& gains, const Visit& visit) {
  visit("flap_filter", &gains.flap_filter);
  visit("flap_alpha_gain", &gains.flap_alpha_gain);
  visit("flap_pressure_gain_deg", &gains.flap_pressure_gain_deg);
  visit("flap_bias_deg", &gains.flap_bias_deg);
}

/// Reads the section `flight_control`. Throws Error as Section does.
void ReadFlightControl(Section section, FlightControlGains* gains);
/// The same, with the leading-edge flap's gains.
void ReadFlightControlWithFlap(Section section, FlightControlGains* gains);

/// The section that ReadFlightControl reads, but for "about".
nlohmann::ordered_json FlightControlJson(const FlightControlGains& gains);

}  // namespace skein
