// SPDX-License-Identifier: Apache-2.0
#include "envs/kernels/flight_control_constants.h"

#include "envs/reference/actuator.h"

namespace skein {
namespace {

FlightControlConstants::Filter MakeFilter(const FirstOrder& law, double dt) {
  const LinearFilter filter = Discretise(law, dt);
  return {static_cast<float>(filter.n0), static_cast<float>(filter.n1),
          static_cast<float>(filter.d1)};
}

FlightControlConstants::Schedule MakeSchedule(const Ramp& ramp) {
  const double slope = (ramp.y_high - ramp.y_low) / (ramp.x_high - ramp.x_low);
  return {static_cast<float>(ramp.x_low), static_cast<float>(ramp.x_high),
          static_cast<float>(slope), static_cast<float>(ramp.y_low - slope * ramp.x_low)};
}

FlightControlConstants::Servo MakeServo(const Actuator& actuator, double dt) {
  return {static_cast<float>(ReachedShare(actuator.bandwidth_per_s, dt)),
          static_cast<float>(actuator.rate_limit_deg_per_s * dt),
          static_cast<float>(actuator.min_deg), static_cast<float>(actuator.max_deg)};
}

}  // namespace

FlightControlConstants::FlightControlConstants(const Aircraft& aircraft,
                                               FlightControlMode control_mode, double interval)
    : mode(control_mode),
      dt(static_cast<float>(interval)),
      military_throttle(static_cast<float>(aircraft.throttle_gearing.military_throttle)),
      dry_gain(static_cast<float>(aircraft.throttle_gearing.dry_gain)),
      afterburner_gain(static_cast<float>(aircraft.throttle_gearing.afterburner_gain)),
      afterburner_offset(static_cast<float>(aircraft.throttle_gearing.afterburner_offset)),
      alpha_min_deg(static_cast<float>(aircraft.flight_control.alpha_min_deg)),
      alpha_max_deg(static_cast<float>(aircraft.flight_control.alpha_max_deg)),
      pitch_gain_pressure_psf(static_cast<float>(aircraft.flight_control.pitch_gain_pressure_psf)),
      roll_gain_pressure_psf(static_cast<float>(aircraft.flight_control.roll_gain_pressure_psf)),
      yaw_gain_pressure_psf(static_cast<float>(aircraft.flight_control.yaw_gain_pressure_psf)),
      max_load_factor_command(static_cast<float>(aircraft.flight_control.max_load_factor_command)),
      max_load_factor_reduction(
          static_cast<float>(aircraft.flight_control.max_load_factor_reduction)),
      min_load_factor_relative_reduction(
          static_cast<float>(aircraft.flight_control.min_load_factor_relative_reduction)),
      pitch_proportional_deg_per_g(
          static_cast<float>(aircraft.flight_control.pitch_proportional_deg_per_g)),
      pitch_integral_per_step(
          static_cast<float>(aircraft.flight_control.pitch_integral_per_s * interval)),
      pitch_rate_gain_g_s_per_deg(
          static_cast<float>(aircraft.flight_control.pitch_rate_gain_g_s_per_deg)),
      alpha_to_elevator(static_cast<float>(aircraft.flight_control.alpha_to_elevator)),
      limiter_rate_lead_s(static_cast<float>(aircraft.flight_control.limiter_rate_lead_s)),
      alpha_onset_deg(static_cast<float>(aircraft.flight_control.alpha_onset_deg)),
      alpha_onset_gain_g_per_deg(
          static_cast<float>(aircraft.flight_control.alpha_onset_gain_g_per_deg)),
      alpha_limit_deg(static_cast<float>(aircraft.flight_control.alpha_limit_deg)),
      alpha_limit_gain_g_per_deg(
          static_cast<float>(aircraft.flight_control.alpha_limit_gain_g_per_deg)),
      pitch_integrator_limit_deg(
          static_cast<float>(aircraft.flight_control.pitch_integrator_limit_deg)),
      max_roll_rate_deg_s(static_cast<float>(aircraft.flight_control.max_roll_rate_deg_s)),
      roll_rate_gain_s(static_cast<float>(aircraft.flight_control.roll_rate_gain_s)),
      roll_integral_per_s(static_cast<float>(aircraft.flight_control.roll_integral_per_s)),
      roll_integrator_gate(static_cast<float>(aircraft.flight_control.roll_integrator_gate)),
      roll_integrator_antiwindup_per_s(
          static_cast<float>(aircraft.flight_control.roll_integrator_antiwindup_per_s)),
      roll_integrator_leak_per_s(
          static_cast<float>(aircraft.flight_control.roll_integrator_leak_per_s)),
      roll_integrator_limit_deg(
          static_cast<float>(aircraft.flight_control.roll_integrator_limit_deg)),
      max_pedal_rudder_deg(static_cast<float>(aircraft.flight_control.max_pedal_rudder_deg)),
      yaw_rate_gain_s(static_cast<float>(aircraft.flight_control.yaw_rate_gain_s)),
      lateral_acceleration_gain_deg_per_g(
          static_cast<float>(aircraft.flight_control.lateral_acceleration_gain_deg_per_g)),
      aileron_rudder_interconnect_per_deg(
          static_cast<float>(aircraft.flight_control.aileron_rudder_interconnect_per_deg)),
      interconnect_min(static_cast<float>(aircraft.flight_control.interconnect_min)),
      interconnect_max(static_cast<float>(aircraft.flight_control.interconnect_max)),
      flap_alpha_gain(static_cast<float>(aircraft.flight_control.flap_alpha_gain)),
      flap_pressure_gain_deg(static_cast<float>(aircraft.flight_control.flap_pressure_gain_deg)),
      flap_bias_deg(static_cast<float>(aircraft.flight_control.flap_bias_deg)),
      alpha(MakeFilter(aircraft.flight_control.alpha_filter, interval)),
      pitch_rate(MakeFilter(aircraft.flight_control.pitch_rate_filter, interval)),
      pitch_rate_washout(MakeFilter(aircraft.flight_control.pitch_rate_washout, interval)),
      load_factor(MakeFilter(aircraft.flight_control.load_factor_filter, interval)),
      load_factor_command(MakeFilter(aircraft.flight_control.load_factor_command_filter, interval)),
      pitch_lead(MakeFilter(aircraft.flight_control.pitch_lead, interval)),
      roll_rate(MakeFilter(aircraft.flight_control.roll_rate_filter, interval)),
      roll_command(MakeFilter(aircraft.flight_control.roll_command_filter, interval)),
      yaw_rate(MakeFilter(aircraft.flight_control.yaw_rate_filter, interval)),
      yaw_washout(MakeFilter(aircraft.flight_control.yaw_washout, interval)),
      yaw_lead(MakeFilter(aircraft.flight_control.yaw_lead, interval)),
      pedal(MakeFilter(aircraft.flight_control.pedal_filter, interval)),
      lateral_acceleration(
          MakeFilter(aircraft.flight_control.lateral_acceleration_filter, interval)),
      flap(MakeFilter(aircraft.flight_control.flap_filter, interval)),
      min_load_factor_command(MakeSchedule(aircraft.flight_control.min_load_factor_command)),
      limiter_rate_fade(MakeSchedule(aircraft.flight_control.limiter_rate_fade)),
      roll_rate_fade(MakeSchedule(aircraft.flight_control.roll_rate_fade)),
      roll_integrator_fade(MakeSchedule(aircraft.flight_control.roll_integrator_fade)),
      pedal_fade(MakeSchedule(aircraft.flight_control.pedal_fade)),
      elevator(MakeServo(aircraft.actuators.elevator, interval)),
      aileron(MakeServo(aircraft.actuators.aileron, interval)),
      rudder(MakeServo(aircraft.actuators.rudder, interval)),
      leading_edge_flap(MakeServo(aircraft.actuators.leading_edge_flap, interval)) {}

}  // namespace skein
