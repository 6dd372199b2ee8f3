// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "envs/aircraft/aircraft_document.h"
#include "envs/aircraft/flight_control_gains.h"

namespace skein {

/// `file` as the aircraft's files are written: objects one key a line, short lists of numbers on
/// one.
std::string AircraftText(const nlohmann::ordered_json& file);

/// The text of a model of derivatives with another section flight_control, which is read once to
/// see that it can be. Throws Error if not.
std::string TextWithGains(const AircraftDocument& document, const FlightControlGains& gains);

}  // namespace skein
