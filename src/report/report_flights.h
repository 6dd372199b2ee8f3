// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "src/evaluation/flight_table.h"
#include "src/report/data_pack.h"

namespace skein {

/// The same episodes flown by every agent, of evaluations with `seed`, for a page to show. Keys:
/// task, conditions, seed, agents (names), targets (column, is_angle, tolerance in the column's
/// unit), is_point, hold_s, flights: agent (its number), episode, end (kTerminationNames), return,
/// interval_s (between rows; long flights leave rows out), columns (by their names in files of
/// flights, references into `pack`).
nlohmann::ordered_json FlightsJson(const std::vector<AgentFlights>& agents, std::uint64_t seed,
                                   DataPack* pack);

}  // namespace skein
