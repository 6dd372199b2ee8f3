// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "envs/env_config.h"
#include "train/export/flight_control_trace.h"

namespace skein {

/// The name of the laws' functions: "f16_flight_control"; of an aircraft "747",
/// "aircraft_747_flight_control".
std::string FlightControlName(const EnvConfig& env);

/// The flight control laws (envs/reference/flight_control.h) of the aircraft of `env`, stepped with
/// its control interval, as one C99 header (train/export/flight_control.h.in): NAME_reset,
/// NAME_step, and NAME_self_test, which flies the beginning of `recorded`. Throws Error if
/// `env.flight_control` leaves the laws out.
std::string CFlightControl(const EnvConfig& env, const FlightControlTrace& recorded,
                           const std::string& version);

}  // namespace skein
