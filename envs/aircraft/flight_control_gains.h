// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

/// The continuous transfer function (b1 s + b0) / (s + a0), with a0 above 0.
struct FirstOrder {
  double b1 = 0, b0 = 0, a0 = 0;
};

/// A value scheduled on one variable: `y_low` up to `x_low`, `y_high` from `x_high` on, a straight
/// line between.
struct Ramp {
  double x_low = 0, y_low = 0;
  double x_high = 1, y_high = 0;
};

/// Gains of the four-channel flight control system. Angles in degrees, rates in deg/s,
/// accelerations in g, dynamic pressure in psf. An aircraft has those of its file; the defaults are
/// Skein's set for the F-16, whose filters `skein aircraft tune` keeps. The laws
/// are in envs/reference/flight_control.h; sources and verification in
/// docs/explanation/flight-control.md.
struct FlightControlGains {
  // Shared by the channels.
  double alpha_min_deg = -5, alpha_max_deg = 30;  ///< range of the angle-of-attack sensor
  FirstOrder alpha_filter{0, 10, 10};
  /// Loop gains fall as min(1, x / qbar): surface power grows with dynamic pressure.
  double pitch_gain_pressure_psf = 300, roll_gain_pressure_psf = 300, yaw_gain_pressure_psf = 300;
  /// With m = max(|roll|, |yaw|) the g command is limited to [g_min (1 - b m), g_max - a m].
  double max_load_factor_command = 8;
  double max_load_factor_reduction = 3;             ///< a
  double min_load_factor_relative_reduction = 0.5;  ///< b
  Ramp min_load_factor_command{100, -1, 500, -4};   ///< on qbar

  // Pitch.
  FirstOrder pitch_rate_filter{0, 50, 50};
  FirstOrder pitch_rate_washout{1, 0, 1};
  FirstOrder load_factor_filter{0, 50, 50};
  FirstOrder load_factor_command_filter{0, 8.3, 8.3};
  FirstOrder pitch_lead{3, 12, 12};
  double pitch_proportional_deg_per_g = 1.5;
  double pitch_integral_per_s = 5;
  double pitch_rate_gain_g_s_per_deg = 0.334;
  double alpha_to_elevator = 0.5;
  double limiter_rate_lead_s = 0.7;           ///< lead of the limiters by washed-out pitch rate
  Ramp limiter_rate_fade{110, 1, 319, 0.32};  ///< times this, on qbar
  double alpha_onset_deg = 15;                ///< alpha feedback above this
  double alpha_onset_gain_g_per_deg = 0.322;
  double alpha_limit_deg = 20.4;  ///< alpha limiter above this
  double alpha_limit_gain_g_per_deg = 1;
  double pitch_integrator_limit_deg = 25;

  // Roll.
  FirstOrder roll_rate_filter{0, 50, 50};
  FirstOrder roll_command_filter{0, 10, 10};
  double max_roll_rate_deg_s = 308;
  Ramp roll_rate_fade{15, 1, 29, 0.25};  ///< of the commanded roll rate, on filtered alpha
  double roll_rate_gain_s = 0.2;
  double roll_integral_per_s = 1;
  Ramp roll_integrator_fade{10, 1, 20, 0};  ///< on filtered alpha
  double roll_integrator_gate = 0.1;        ///< integrates only while |roll| is below
  double roll_integrator_antiwindup_per_s = 2;
  double roll_integrator_leak_per_s = 0.5;
  double roll_integrator_limit_deg = 5;

  // Yaw.
  FirstOrder yaw_rate_filter{0, 50, 50};
  FirstOrder yaw_washout{1.5, 0, 1};
  FirstOrder yaw_lead{3, 15, 15};
  FirstOrder pedal_filter{0, 4, 4};
  FirstOrder lateral_acceleration_filter{0, 20, 20};
  double max_pedal_rudder_deg = 30;
  Ramp pedal_fade{20, 1, 30, 0};  ///< on filtered alpha
  double yaw_rate_gain_s = 0.75;
  double lateral_acceleration_gain_deg_per_g = 4.8;
  double aileron_rudder_interconnect_per_deg = 0.05;  ///< of filtered alpha
  double interconnect_min = -0.3, interconnect_max = 1.5;

  // Leading-edge flap: gain H(s) alpha - pressure_gain qbar/ps + bias.
  FirstOrder flap_filter{2, 7.25, 7.25};
  double flap_alpha_gain = 1.38;
  double flap_pressure_gain_deg = 9.05;
  double flap_bias_deg = 1.45;
};

}  // namespace skein
