// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "envs/reference/linear_flight.h"
#include "envs/tuning/closed_loop_outputs.h"
#include "envs/tuning/linear_modes.h"
#include "src/fdm/steady_flight.h"

namespace skein {

/// An axis with flight control, one control step at a time: x' = A x + B u, y = C x.
struct LinearLoop {
  LoopAxis axis = LoopAxis::kLongitudinal;
  ClosedLoopModel model;
  ClosedLoopOutputs outputs;
  std::vector<LinearMode> modes;
};

/// A steady flight's linear models: of the bare airframe, and of both axes with flight control,
/// which decouple in straight flight alone: turns and pull-ups have no `loops`.
struct LinearisedFlight {
  SteadyFlightRequest request;
  SteadyFlight flight;
  LinearFlight bare;
  std::vector<FlightMode> modes;
  std::vector<LinearLoop> loops;
};

/// In still air. Throws as FindSteadyFlight.
LinearisedFlight LineariseSteadyFlight(const Plant& plant, const SteadyFlightRequest& request,
                                       FlapMotion flap);

/// The matrices of the bare airframe and all modes, for people.
std::string Describe(const LinearisedFlight& linearised);
/// The modes of the bare airframe at several points, a line each.
std::string DescribeModes(const std::vector<LinearisedFlight>& flights);

nlohmann::ordered_json ToJson(const LinearisedFlight& linearised);

}  // namespace skein
