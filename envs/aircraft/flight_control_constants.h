#pragma once

#include "envs/aircraft/flight_control.h"

namespace skein {

/// What the flight control kernel computes once per tile from the aircraft and the control
/// interval, in float32: discretised filters, ramps as slope and offset, exact actuator responses.
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

  FlightControlConstants(const Aircraft& aircraft, double dt);

  FlightControlGains gains;
  float dt;
  Filter alpha, pitch_rate, pitch_rate_washout, load_factor, load_factor_command, pitch_lead;
  Filter roll_rate, roll_command, yaw_rate, yaw_washout, yaw_lead, pedal, lateral_acceleration;
  Filter flap;
  Schedule min_load_factor_command, limiter_rate_fade, roll_rate_fade, roll_integrator_fade;
  Schedule pedal_fade;
  Servo elevator, aileron, rudder, leading_edge_flap;
};

}  // namespace skein
