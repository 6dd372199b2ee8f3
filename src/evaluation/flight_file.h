// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/worker_pool.h"
#include "envs/env_config.h"
#include "src/evaluation/flight_table.h"
#include "train/policy/record_flights.h"

namespace skein {

/// The text of a file of flights (docs/reference/file-formats.md): a header, and the rows of every
/// flight's FlightTable. With observations, each row also has what the policy observed at the
/// beginning of its policy step, scaled and noisy as it saw it; the row at time 0 has none. What a
/// pool that is asked to stop leaves is incomplete.
std::string FlightsCsv(const EnvConfig& env, const std::vector<RecordedFlight>& flights,
                       FlightColumns columns = FlightColumns::kStates,
                       const WorkerPool* pool = nullptr);

}  // namespace skein
