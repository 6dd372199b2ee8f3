// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/reference/plant.h"
#include "envs/tuning/flight_envelope.h"

namespace skein {

/// What flight control must keep to.
struct TuningLimits {
  double max_load_factor_g = 4, min_load_factor_g = -2;
  EnvelopeLimits envelope;
};

/// Gains of flight control for `plant`'s aircraft, whose own are not looked at. From its trims and
/// linear models over the envelope; the method is described in docs/explanation/flight-control.md.
/// Throws Error where there is no level flight. Takes seconds.
FlightControlGains TuneFlightControl(const Plant& plant, const TuningLimits& limits);

}  // namespace skein
