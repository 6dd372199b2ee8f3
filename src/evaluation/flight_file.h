// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "envs/env_config.h"
#include "train/policy/record_flights.h"

namespace skein {

enum class FlightColumns { kStates, kStatesAndObservations };
/// The text of a file of flights (docs/reference/file-formats.md): a header, and for every flight a
/// row at time 0 and one at the end of each control step, in feet, seconds and degrees. With
/// observations, each row also has what the policy observed at the beginning of its policy step,
/// scaled and noisy as it saw it; the row at time 0 has none.
std::string FlightsCsv(const EnvConfig& env, const std::vector<RecordedFlight>& flights,
                       FlightColumns columns = FlightColumns::kStates);

}  // namespace skein
