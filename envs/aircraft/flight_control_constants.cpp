#include "envs/aircraft/flight_control_constants.h"

#include <cmath>

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
  return {static_cast<float>(-std::expm1(-actuator.bandwidth_per_s * dt)),
          static_cast<float>(actuator.rate_limit_deg_per_s * dt),
          static_cast<float>(actuator.min_deg), static_cast<float>(actuator.max_deg)};
}

}  // namespace

FlightControlConstants::FlightControlConstants(const Aircraft& aircraft, double interval)
    : gains(aircraft.flight_control),
      dt(static_cast<float>(interval)),
      alpha(MakeFilter(gains.alpha_filter, interval)),
      pitch_rate(MakeFilter(gains.pitch_rate_filter, interval)),
      pitch_rate_washout(MakeFilter(gains.pitch_rate_washout, interval)),
      load_factor(MakeFilter(gains.load_factor_filter, interval)),
      load_factor_command(MakeFilter(gains.load_factor_command_filter, interval)),
      pitch_lead(MakeFilter(gains.pitch_lead, interval)),
      roll_rate(MakeFilter(gains.roll_rate_filter, interval)),
      roll_command(MakeFilter(gains.roll_command_filter, interval)),
      yaw_rate(MakeFilter(gains.yaw_rate_filter, interval)),
      yaw_washout(MakeFilter(gains.yaw_washout, interval)),
      yaw_lead(MakeFilter(gains.yaw_lead, interval)),
      pedal(MakeFilter(gains.pedal_filter, interval)),
      lateral_acceleration(MakeFilter(gains.lateral_acceleration_filter, interval)),
      flap(MakeFilter(gains.flap_filter, interval)),
      min_load_factor_command(MakeSchedule(gains.min_load_factor_command)),
      limiter_rate_fade(MakeSchedule(gains.limiter_rate_fade)),
      roll_rate_fade(MakeSchedule(gains.roll_rate_fade)),
      roll_integrator_fade(MakeSchedule(gains.roll_integrator_fade)),
      pedal_fade(MakeSchedule(gains.pedal_fade)),
      elevator(MakeServo(aircraft.actuators.elevator, interval)),
      aileron(MakeServo(aircraft.actuators.aileron, interval)),
      rudder(MakeServo(aircraft.actuators.rudder, interval)),
      leading_edge_flap(MakeServo(aircraft.actuators.leading_edge_flap, interval)) {}

}  // namespace skein
