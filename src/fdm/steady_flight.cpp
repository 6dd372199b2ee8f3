// SPDX-License-Identifier: Apache-2.0
#include "src/fdm/steady_flight.h"

#include <cmath>

#include "envs/aircraft/engine.h"
#include "envs/state/attitude.h"
#include "envs/state/state.h"
#include "src/config/usage_error.h"

namespace skein {

double SteadyFlight::lift_coefficient() const {
  return output.coefficients[0] * std::sin(trim.alpha_rad) -
         output.coefficients[2] * std::cos(trim.alpha_rad);
}

double SteadyFlight::drag_coefficient() const {
  return -output.coefficients[0] * std::cos(trim.alpha_rad) -
         output.coefficients[2] * std::sin(trim.alpha_rad);
}

double SteadyFlight::ground_speed_ft_s() const {
  return std::hypot(output.state_rate[kNorth], output.state_rate[kEast]);
}

std::array<std::pair<const char*, double>, 10> SteadyFlight::Numbers() const {
  return {{{"alpha_deg", trim.alpha_rad * kDegPerRad},
           {"beta_deg", output.air.beta_rad * kDegPerRad},
           {"bank_deg", trim.bank_rad * kDegPerRad},
           {"pitch_deg", trim.pitch_rad * kDegPerRad},
           {"load_factor_g", output.nz},
           {"lift_coefficient", lift_coefficient()},
           {"drag_coefficient", drag_coefficient()},
           {"mach", output.air.mach},
           {"qbar_psf", output.air.dynamic_pressure_psf},
           {"residual", trim.residual}}};
}

TrimRequest ToTrimRequest(const Plant& plant, const SteadyFlightRequest& request) {
  TrimRequest asked{request.altitude_ft, request.true_airspeed_ft_s,
                    request.flight_path_deg / kDegPerRad, request.turn_rate_deg_s / kDegPerRad};
  if (!request.load_factor) return asked;
  if (request.turn_rate_deg_s != 0) {
    throw UsageError("a pull-up has level wings: give a load factor or a turn rate, not both");
  }
  asked.pull_up_rate_rad_s = plant.gravity().At(request.altitude_ft) *
                             (*request.load_factor - std::cos(asked.flight_path_angle_rad)) /
                             request.true_airspeed_ft_s;
  return asked;
}

SteadyFlight FindSteadyFlight(const Plant& plant, const SteadyFlightRequest& request) {
  const TrimRequest asked = ToTrimRequest(plant, request);
  const Aircraft& aircraft = plant.aircraft();
  SteadyFlight flight;
  flight.trim = TrimOrExplain(plant, asked);
  flight.exceeded_limits = ExceededLimits(plant, asked, flight.trim);
  flight.trim.state.segment<3>(kU) +=
      BodyFromNed(flight.trim.state.segment<4>(kQ0)) * request.wind_ft_s;
  flight.output = plant.Evaluate(flight.trim.state, flight.trim.controls, request.wind_ft_s);
  flight.throttle = ThrottleForPower(aircraft.throttle_gearing, flight.trim.power);
  flight.available_thrust_lbf =
      Thrust(aircraft.engine, kMaximumPower, request.altitude_ft, flight.output.air.mach);
  flight.excess_power_ft_s =
      request.true_airspeed_ft_s * (flight.available_thrust_lbf - flight.trim.controls.thrust_lbf) /
      (aircraft.airframe.mass_slug * plant.gravity().At(request.altitude_ft));
  return flight;
}

}  // namespace skein
