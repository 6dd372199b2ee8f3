// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/reference/flight_control.h"

namespace skein {

/// What the flight control kernel works with, made once from the aircraft and the control interval
/// in seconds, in float32: throttle gearing, gains, discretised filters, ramps as slope and offset,
/// exact actuator responses.
struct FlightControlConstants {
  /// As LinearFilter.
  struct Filter {
    float n0, n1, d1;
  };
  /// y = slope clip(x, x_low, x_high) + offset.
  struct Schedule {
    float x_low, x_high, slope, offset;
  };
  struct Servo {
    float reached;  ///< fraction of the way to the command in one interval
    float largest_step_deg;
    float min_deg, max_deg;
  };

  FlightControlConstants(const Aircraft& aircraft, FlightControlMode mode, double interval);

  FlightControlMode mode;
  float dt;
  // As in ThrottleGearing.
  float military_throttle, dry_gain, afterburner_gain, afterburner_offset;
  // Named and in units as in FlightControlGains.
  float alpha_min_deg, alpha_max_deg;
  float pitch_gain_pressure_psf, roll_gain_pressure_psf, yaw_gain_pressure_psf;
  float max_load_factor_command, max_load_factor_reduction, min_load_factor_relative_reduction;
  float pitch_proportional_deg_per_g, pitch_integral_per_step, pitch_rate_gain_g_s_per_deg;
  float alpha_to_elevator, limiter_rate_lead_s;
  float alpha_onset_deg, alpha_onset_gain_g_per_deg, alpha_limit_deg, alpha_limit_gain_g_per_deg;
  float pitch_integrator_limit_deg;
  float max_roll_rate_deg_s, roll_rate_gain_s;
  float roll_integral_per_s, roll_integrator_gate, roll_integrator_antiwindup_per_s;
  float roll_integrator_leak_per_s, roll_integrator_limit_deg;
  float max_pedal_rudder_deg, yaw_rate_gain_s, lateral_acceleration_gain_deg_per_g;
  float aileron_rudder_interconnect_per_deg, interconnect_min, interconnect_max;
  float flap_alpha_gain, flap_pressure_gain_deg, flap_bias_deg;

  Filter alpha, pitch_rate, pitch_rate_washout, load_factor, load_factor_command, pitch_lead;
  Filter roll_rate, roll_command, yaw_rate, yaw_washout, yaw_lead, pedal, lateral_acceleration;
  Filter flap;
  Schedule min_load_factor_command, limiter_rate_fade, roll_rate_fade, roll_integrator_fade;
  Schedule pedal_fade;
  Servo elevator, aileron, rudder, leading_edge_flap;
};

}  // namespace skein
