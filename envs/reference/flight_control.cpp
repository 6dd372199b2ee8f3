// SPDX-License-Identifier: Apache-2.0
#include "envs/reference/flight_control.h"

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

double Clip(double value, const Actuator& actuator) {
  return std::clamp(value, actuator.min_deg, actuator.max_deg);
}

// Loop gain that falls with dynamic pressure, from 1.
double PressureGain(double pressure_psf, double dynamic_pressure_psf) {
  return pressure_psf / std::max(pressure_psf, dynamic_pressure_psf);
}

// How far beyond the alpha limits the limiters see the aircraft: alpha ahead by the pitch rate.
double LimiterLead(const FlightControlGains& g, double washed_pitch_rate, double qbar) {
  return g.limiter_rate_lead_s * Evaluate(g.limiter_rate_fade, qbar) * washed_pitch_rate;
}

// Alpha, pitch rate and load factor fed back to the elevator, g.
double PitchFeedback(const FlightControlGains& g, double alpha, double lead,
                     double washed_pitch_rate, double load_factor) {
  return std::max(0.0, g.alpha_onset_gain_g_per_deg * (alpha - g.alpha_onset_deg + lead)) +
         g.pitch_rate_gain_g_s_per_deg * washed_pitch_rate + load_factor;
}

double AlphaLimiter(const FlightControlGains& g, double alpha, double lead) {
  return std::max(0.0, g.alpha_limit_gain_g_per_deg * (alpha - g.alpha_limit_deg + lead));
}

double FlapSchedule(const FlightControlGains& g, double led_alpha_deg, const FlightSensors& s) {
  return g.flap_alpha_gain * led_alpha_deg -
         g.flap_pressure_gain_deg * s.dynamic_pressure_psf / s.static_pressure_psf +
         g.flap_bias_deg;
}

}  // namespace

LinearFilter Discretise(const FirstOrder& law, double dt) {
  const double k = 2 / dt;
  const double scale = 1 / (k + law.a0);
  return {(law.b1 * k + law.b0) * scale, (-law.b1 * k + law.b0) * scale, (-k + law.a0) * scale};
}

double Evaluate(const Ramp& ramp, double x) {
  const double fraction = std::clamp((x - ramp.x_low) / (ramp.x_high - ramp.x_low), 0.0, 1.0);
  return ramp.y_low + (ramp.y_high - ramp.y_low) * fraction;
}

double SteadyLeadingEdgeFlap(const Aircraft& aircraft, double alpha_deg,
                             double dynamic_pressure_psf, double static_pressure_psf) {
  FlightSensors sensors;
  sensors.dynamic_pressure_psf = dynamic_pressure_psf;
  sensors.static_pressure_psf = static_pressure_psf;
  return Clip(FlapSchedule(aircraft.flight_control, alpha_deg, sensors),
              aircraft.actuators.leading_edge_flap);
}

FlightControl::FlightControl(const Aircraft& aircraft, FlightControlMode mode, double dt)
    : gains_(aircraft.flight_control), actuators_(aircraft.actuators), mode_(mode), dt_(dt) {
  const FlightControlGains& g = gains_;
  filters_.alpha = Discretise(g.alpha_filter, dt);
  filters_.pitch_rate = Discretise(g.pitch_rate_filter, dt);
  filters_.pitch_rate_washout = Discretise(g.pitch_rate_washout, dt);
  filters_.load_factor = Discretise(g.load_factor_filter, dt);
  filters_.load_factor_command = Discretise(g.load_factor_command_filter, dt);
  filters_.pitch_lead = Discretise(g.pitch_lead, dt);
  filters_.roll_rate = Discretise(g.roll_rate_filter, dt);
  filters_.roll_command = Discretise(g.roll_command_filter, dt);
  filters_.yaw_rate = Discretise(g.yaw_rate_filter, dt);
  filters_.yaw_washout = Discretise(g.yaw_washout, dt);
  filters_.yaw_lead = Discretise(g.yaw_lead, dt);
  filters_.pedal = Discretise(g.pedal_filter, dt);
  filters_.lateral_acceleration = Discretise(g.lateral_acceleration_filter, dt);
  filters_.flap = Discretise(g.flap_filter, dt);
}

FlightControlState FlightControl::InitialState(const FlightSensors& sensors,
                                               const SurfaceAngles& surfaces) const {
  const FlightControlGains& g = gains_;
  const double qbar = sensors.dynamic_pressure_psf;
  FlightControlState state{};
  const auto at = [&state](Column column) -> double& { return state[column - kAlphaFilter]; };

  const double alpha = std::clamp(sensors.alpha_deg, g.alpha_min_deg, g.alpha_max_deg);
  at(kAlphaFilter) = filters_.alpha.SteadyState(alpha);
  at(kPitchRateFilter) = filters_.pitch_rate.SteadyState(sensors.pitch_rate_deg_s);
  at(kPitchRateWashout) = filters_.pitch_rate_washout.SteadyState(sensors.pitch_rate_deg_s);
  at(kLoadFactorFilter) = filters_.load_factor.SteadyState(sensors.nz - 1);
  const double feedback = PitchFeedback(g, alpha, 0, 0, sensors.nz - 1);
  at(kPitchLeadFilter) = filters_.pitch_lead.SteadyState(feedback);
  const double pitch_error = g.pitch_proportional_deg_per_g *
                             PressureGain(g.pitch_gain_pressure_psf, qbar) *
                             (AlphaLimiter(g, alpha, 0) + feedback);
  at(kPitchIntegrator) =
      std::clamp(surfaces.elevator_deg - pitch_error - g.alpha_to_elevator * alpha,
                 -g.pitch_integrator_limit_deg, g.pitch_integrator_limit_deg);

  at(kRollRateFilter) = filters_.roll_rate.SteadyState(sensors.roll_rate_deg_s);
  at(kTrimAileron) = surfaces.aileron_deg - g.roll_rate_gain_s *
                                                PressureGain(g.roll_gain_pressure_psf, qbar) *
                                                sensors.roll_rate_deg_s;

  at(kYawRateFilter) = filters_.yaw_rate.SteadyState(sensors.yaw_rate_deg_s);
  at(kYawWashout) = filters_.yaw_washout.SteadyState(sensors.yaw_rate_deg_s -
                                                     sensors.roll_rate_deg_s * alpha / kDegPerRad);
  at(kLateralAccelerationFilter) = filters_.lateral_acceleration.SteadyState(sensors.ny);
  const double interconnect = std::clamp(g.aileron_rudder_interconnect_per_deg * alpha,
                                         g.interconnect_min, g.interconnect_max);
  at(kTrimRudder) = surfaces.rudder_deg -
                    g.lateral_acceleration_gain_deg_per_g *
                        PressureGain(g.yaw_gain_pressure_psf, qbar) * sensors.ny -
                    interconnect * (surfaces.aileron_deg - at(kTrimAileron));

  at(kFlapFilter) = filters_.flap.SteadyState(sensors.alpha_deg);
  return state;
}

SurfaceAngles FlightControl::Step(const PilotCommands& pilot, const FlightSensors& sensors,
                                  FlightControlState* state) const {
  PilotCommands sticks = pilot;
  sticks.pitch = std::clamp(pilot.pitch, -1.0, 1.0);
  sticks.roll = std::clamp(pilot.roll, -1.0, 1.0);
  sticks.yaw = std::clamp(pilot.yaw, -1.0, 1.0);
  return mode_ == FlightControlMode::kFull ? StepFull(sticks, sensors, state)
                                           : StepDirect(sticks, sensors);
}

SurfaceAngles FlightControl::StepFull(const PilotCommands& pilot, const FlightSensors& sensors,
                                      FlightControlState* state) const {
  const FlightControlGains& g = gains_;
  const double qbar = sensors.dynamic_pressure_psf;
  const auto at = [state](Column column) -> double* { return &(*state)[column - kAlphaFilter]; };
  SurfaceAngles command;

  const double alpha = filters_.alpha.Step(
      std::clamp(sensors.alpha_deg, g.alpha_min_deg, g.alpha_max_deg), at(kAlphaFilter));

  // Pitch: elevator from commanded against felt load factor, inside the alpha limits.
  const double pitch_rate =
      filters_.pitch_rate.Step(sensors.pitch_rate_deg_s, at(kPitchRateFilter));
  const double washed_pitch_rate =
      filters_.pitch_rate_washout.Step(pitch_rate, at(kPitchRateWashout));
  const double load_factor = filters_.load_factor.Step(sensors.nz - 1, at(kLoadFactorFilter));
  const double lateral_stick = std::max(std::abs(pilot.roll), std::abs(pilot.yaw));
  const double min_load_factor = Evaluate(g.min_load_factor_command, qbar);
  const double wanted =
      pilot.pitch >= 0 ? g.max_load_factor_command * pilot.pitch : -min_load_factor * pilot.pitch;
  const double load_factor_command = filters_.load_factor_command.Step(
      std::clamp(wanted,
                 min_load_factor * (1 - g.min_load_factor_relative_reduction * lateral_stick),
                 g.max_load_factor_command - g.max_load_factor_reduction * lateral_stick),
      at(kLoadFactorCommandFilter));
  const double lead = LimiterLead(g, washed_pitch_rate, qbar);
  const double feedback = filters_.pitch_lead.Step(
      PitchFeedback(g, alpha, lead, washed_pitch_rate, load_factor), at(kPitchLeadFilter));
  const double pitch_error = g.pitch_proportional_deg_per_g *
                             PressureGain(g.pitch_gain_pressure_psf, qbar) *
                             (AlphaLimiter(g, alpha, lead) - load_factor_command + feedback);
  double* pitch_integrator = at(kPitchIntegrator);
  const double raw_elevator = *pitch_integrator + pitch_error + g.alpha_to_elevator * alpha;
  command.elevator_deg = Clip(raw_elevator, actuators_.elevator);
  *pitch_integrator =
      std::clamp(*pitch_integrator + dt_ * g.pitch_integral_per_s *
                                         (pitch_error - (raw_elevator - command.elevator_deg)),
                 -g.pitch_integrator_limit_deg, g.pitch_integrator_limit_deg);

  // Roll: ailerons from commanded against felt roll rate.
  const double roll_rate = filters_.roll_rate.Step(sensors.roll_rate_deg_s, at(kRollRateFilter));
  const double roll_rate_command = filters_.roll_command.Step(
      g.max_roll_rate_deg_s * Evaluate(g.roll_rate_fade, alpha) * pilot.roll,
      at(kRollCommandFilter));
  const double roll_error = g.roll_rate_gain_s * PressureGain(g.roll_gain_pressure_psf, qbar) *
                            (roll_rate - roll_rate_command);
  double* roll_integrator = at(kRollIntegrator);
  const double trim_aileron = *at(kTrimAileron);
  const double raw_aileron = roll_error + *roll_integrator + trim_aileron;
  command.aileron_deg = Clip(raw_aileron, actuators_.aileron);
  const double integrator_fade = Evaluate(g.roll_integrator_fade, alpha);
  const double gate = std::abs(pilot.roll) < g.roll_integrator_gate ? integrator_fade : 0;
  *roll_integrator = std::clamp(
      *roll_integrator +
          dt_ * (g.roll_integral_per_s * roll_error * gate -
                 g.roll_integrator_antiwindup_per_s * (raw_aileron - command.aileron_deg) -
                 g.roll_integrator_leak_per_s * (1 - integrator_fade) * *roll_integrator),
      -g.roll_integrator_limit_deg, g.roll_integrator_limit_deg);

  // Yaw: rudder from the pedals, stability-axis yaw rate, side force and the ailerons.
  const double yaw_gain = PressureGain(g.yaw_gain_pressure_psf, qbar);
  const double yaw_rate = filters_.yaw_rate.Step(sensors.yaw_rate_deg_s, at(kYawRateFilter));
  const double pedal_rudder =
      filters_.pedal.Step(g.max_pedal_rudder_deg * pilot.yaw, at(kPedalFilter));
  const double washed_yaw_rate = filters_.yaw_lead.Step(
      filters_.yaw_washout.Step(yaw_rate - roll_rate * alpha / kDegPerRad, at(kYawWashout)),
      at(kYawLeadFilter));
  const double lateral_acceleration =
      filters_.lateral_acceleration.Step(sensors.ny, at(kLateralAccelerationFilter));
  const double interconnect = std::clamp(g.aileron_rudder_interconnect_per_deg * alpha,
                                         g.interconnect_min, g.interconnect_max);
  command.rudder_deg =
      Clip(-pedal_rudder * Evaluate(g.pedal_fade, alpha) * yaw_gain +
               g.yaw_rate_gain_s * yaw_gain * washed_yaw_rate +
               g.lateral_acceleration_gain_deg_per_g * yaw_gain * lateral_acceleration +
               interconnect * (command.aileron_deg - trim_aileron) + *at(kTrimRudder),
           actuators_.rudder);

  const double led_alpha = filters_.flap.Step(sensors.alpha_deg, at(kFlapFilter));
  command.leading_edge_flap_deg =
      Clip(FlapSchedule(g, led_alpha, sensors), actuators_.leading_edge_flap);
  return command;
}

SurfaceAngles FlightControl::StepDirect(const PilotCommands& pilot,
                                        const FlightSensors& sensors) const {
  const auto deflection = [](const Actuator& surface, double stick) {
    return stick > 0 ? stick * surface.min_deg : -stick * surface.max_deg;
  };
  SurfaceAngles command;
  command.elevator_deg = deflection(actuators_.elevator, pilot.pitch);
  command.aileron_deg = deflection(actuators_.aileron, pilot.roll);
  command.rudder_deg = deflection(actuators_.rudder, pilot.yaw);
  command.leading_edge_flap_deg =
      Clip(FlapSchedule(gains_, sensors.alpha_deg, sensors), actuators_.leading_edge_flap);
  return command;
}

}  // namespace skein
