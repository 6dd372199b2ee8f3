// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <utility>

#include "envs/aircraft/aircraft.h"
#include "envs/state/state.h"

namespace skein {

enum class FlightControlMode {
  kFull,    ///< pilot commands through the flight control system
  kDirect,  ///< full stick is a surface at its limit of that side; leading-edge flap on its steady
            ///< schedule
};
inline constexpr std::array<std::pair<FlightControlMode, const char*>, 2> kFlightControlNames{
    {{FlightControlMode::kFull, "full"}, {FlightControlMode::kDirect, "direct"}}};

/// Throttle in [0, 1]; pitch (+ nose up), roll (+ right wing down), yaw (+ nose right) in [-1, 1].
struct PilotCommands {
  double throttle = 0;
  double pitch = 0, roll = 0, yaw = 0;
};

/// What the flight control system measures.
struct FlightSensors {
  double alpha_deg = 0;
  double roll_rate_deg_s = 0, pitch_rate_deg_s = 0, yaw_rate_deg_s = 0;
  /// Specific forces at the centre of gravity, g: nz = -Fz/(m g), ny = Fy/(m g).
  double nz = 1, ny = 0;
  double dynamic_pressure_psf = 0, static_pressure_psf = 0;
};

/// Surface positions or commands, degrees (signs: docs/reference/conventions.md).
struct SurfaceAngles {
  double elevator_deg = 0, aileron_deg = 0, rudder_deg = 0, leading_edge_flap_deg = 0;
};

/// A first-order filter in steps of dt, in transposed direct form II: one state s per filter,
///   y = n0 x + s;   s' = n1 x - d1 y.
struct LinearFilter {
  double n0 = 0, n1 = 0, d1 = 0;

  /// Output for input `x`; `state` moves on by one step.
  double Step(double x, double* state) const {
    const double y = n0 * x + *state;
    *state = n1 * x - d1 * y;
    return y;
  }
  /// The state in which a constant input `x` gives a constant output. (d1 is never -1: a0 > 0.)
  double SteadyState(double x) const { return (n1 - d1 * n0) / (1 + d1) * x; }
};

/// Bilinear (Tustin) discretisation of (b1 s + b0) / (s + a0), with k = 2 / dt:
///   n0 = (b1 k + b0) / (k + a0), n1 = (-b1 k + b0) / (k + a0), d1 = (-k + a0) / (k + a0).
LinearFilter Discretise(const FirstOrder& law, double dt);

/// The value of `ramp` at `x`.
double Evaluate(const Ramp& ramp, double x);

/// One number per flight control column of envs/state/state.h: element i is column
/// kAlphaFilter + i. The columns and what they hold (filter states s as in LinearFilter):
///   kAlphaFilter                alpha, clipped to the sensor's range, deg -> alpha_f
///   kPitchRateFilter            q, deg/s -> q_f
///   kPitchRateWashout           q_f -> q_w
///   kLoadFactorFilter           nz - 1, g
///   kLoadFactorCommandFilter    limited g command
///   kPitchLeadFilter            u, the pitch feedback, g
///   kPitchIntegrator            elevator, deg
///   kRollRateFilter             p, deg/s -> p_f
///   kRollCommandFilter          commanded roll rate, deg/s -> p_c
///   kRollIntegrator             aileron, deg
///   kYawRateFilter              r, deg/s -> r_f
///   kYawWashout, kYawLeadFilter stability-axis yaw rate r_f - p_f alpha_f [rad], deg/s
///   kPedalFilter                rudder asked by the pedals, deg
///   kLateralAccelerationFilter  ny, g
///   kFlapFilter                 alpha (not clipped), deg
///   kTrimAileron, kTrimRudder   constants of the flight, deg
inline constexpr int kNumFlightControlStates = kNumColumns - kAlphaFilter;
using FlightControlState = std::array<double, kNumFlightControlStates>;

/// The four-channel flight control system in double precision: the specification of
/// envs/kernels/flight_control_kernel.h. One step of `dt` seconds, from sensors to surface
/// commands; F_x = min(1, x_gain_pressure / qbar), gains as named in FlightControlGains:
///
///   pitch  g_c = clip(pitch >= 0 ? g_max pitch : g_min |pitch|; g_min (1 - b m), g_max - a m),
///          filtered,
///          with m = max(|roll|, |yaw|) and g_min by qbar
///          lead = 0.7 fade(qbar) q_w
///          u = max(0, 0.322 (alpha_f - 15 + lead)) + 0.334 q_w + (nz - 1)_f
///          e = 1.5 F_pitch (max(0, alpha_f - 20.4 + lead) - g_c + H_lead(u))
///          raw = I + e + 0.5 alpha_f;  elevator = clip(raw)
///          I' = 5 (e - (raw - elevator)), |I| <= 25
///   roll   e = 0.2 F_roll (p_f - p_c), p_c = 308 fade(alpha_f) roll, filtered
///          raw = e + I + trim;  aileron = clip(raw)
///          fade = 1 to 0 over alpha_f 10..20
///          I' = e fade [|roll| < 0.1] - 2 (raw - aileron) - 0.5 I (1 - fade), |I| <= 5
///   yaw    raw = -pedal_f fade(alpha_f) F_yaw + 0.75 F_yaw H_lead(H_washout(r_f - p_f alpha_f))
///                + 4.8 F_yaw ny_f + clip(0.05 alpha_f; -0.3, 1.5) (aileron - trim aileron) + trim
///          rudder = clip(raw)
///   flap   clip(1.38 H_flap(alpha) - 9.05 qbar / ps + 1.45)
///
/// Outputs are clipped to the actuators' position limits; integrators take one forward Euler step.
class FlightControl {
 public:
  /// `dt` is the control interval, s.
  FlightControl(const Aircraft& aircraft, FlightControlMode mode, double dt);

  /// The state in which the filters are at rest with these readings and the system commands
  /// `surfaces` with centred sticks (flap apart, which follows its schedule).
  FlightControlState InitialState(const FlightSensors& sensors,
                                  const SurfaceAngles& surfaces) const;

  /// Surface commands of one control step; `state` moves on. Stick commands are clipped to [-1, 1].
  SurfaceAngles Step(const PilotCommands& pilot, const FlightSensors& sensors,
                     FlightControlState* state) const;

 private:
  struct Filters {
    LinearFilter alpha, pitch_rate, pitch_rate_washout, load_factor, load_factor_command,
        pitch_lead, roll_rate, roll_command, yaw_rate, yaw_washout, yaw_lead, pedal,
        lateral_acceleration, flap;
  };

  SurfaceAngles StepFull(const PilotCommands& pilot, const FlightSensors& sensors,
                         FlightControlState* state) const;
  SurfaceAngles StepDirect(const PilotCommands& pilot, const FlightSensors& sensors) const;

  FlightControlGains gains_;
  Actuators actuators_;
  FlightControlMode mode_;
  double dt_;
  Filters filters_;
};

/// Leading-edge flap in steady flight, deg: 1.38 alpha - 9.05 qbar / ps + 1.45, clipped to the
/// actuator's limits (NASA TP-1538).
double SteadyLeadingEdgeFlap(const Aircraft& aircraft, double alpha_deg,
                             double dynamic_pressure_psf, double static_pressure_psf);

}  // namespace skein
