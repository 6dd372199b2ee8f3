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
/// unit), is_point, hold_s, span_ft (of the aircraft), flights: agent (its number), episode, end
/// (kTerminationNames), return, duration_s, new_target_s (when a mission's next target came),
/// reached_s (when a target counted as reached), interval_s (between rows; the last one, at
/// duration_s, may come sooner), columns (by their names in files of flights, references into
/// `pack`). So that a page stays small long flights leave rows out, but never the last one, and so
/// do many that have more than `most_rows` together, whose columns are kept less finely, too.
nlohmann::ordered_json FlightsJson(const std::vector<AgentFlights>& agents, std::uint64_t seed,
                                   std::size_t most_rows, DataPack* pack);

/// Of all flights of a page.
inline constexpr std::size_t kMostRowsOfPage = 100000;

}  // namespace skein
