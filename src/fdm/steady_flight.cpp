// SPDX-License-Identifier: Apache-2.0
#include "src/fdm/steady_flight.h"

#include "envs/state/attitude.h"
#include "src/fdm/trim_limits.h"

namespace skein {

std::array<std::pair<const char*, double>, 8> SteadyFlight::Numbers() const {
  return {{{"alpha_deg", trim.alpha_rad * kDegPerRad},
           {"beta_deg", output.air.beta_rad * kDegPerRad},
           {"bank_deg", trim.bank_rad * kDegPerRad},
           {"pitch_deg", trim.pitch_rad * kDegPerRad},
           {"load_factor_g", output.nz},
           {"mach", output.air.mach},
           {"qbar_psf", output.air.dynamic_pressure_psf},
           {"residual", trim.residual}}};
}

SteadyFlight FindSteadyFlight(const Plant& plant, const SteadyFlightRequest& request) {
  const TrimRequest asked{request.altitude_ft, request.true_airspeed_ft_s,
                          request.flight_path_deg / kDegPerRad,
                          request.turn_rate_deg_s / kDegPerRad};
  SteadyFlight flight;
  flight.trim = TrimOrExplain(plant, asked);
  flight.output = plant.Evaluate(flight.trim.state, flight.trim.controls);
  flight.exceeded_limits = ExceededLimits(plant, asked, flight.trim);
  return flight;
}

}  // namespace skein
