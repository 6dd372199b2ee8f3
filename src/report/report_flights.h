// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/worker_pool.h"
#include "src/evaluation/comparison.h"
#include "src/report/data_pack.h"

namespace skein {

/// The first `count` episodes of evaluations of `env` with `seed`, flown by every agent, for a page
/// to show. Keys: task, conditions, seed, agents (names), targets (column, is_angle, tolerance in
/// the column's unit), is_point, hold_s, flights: agent (its number), episode, end
/// (kTerminationNames), return, interval_s (between rows; long flights leave rows out), columns (by
/// their names in files of flights, references into `pack`).
nlohmann::ordered_json FlightsJson(const std::vector<NamedAgent>& agents, const EnvConfig& env,
                                   int count, std::uint64_t seed, WorkerPool& pool, DataPack* pack);

}  // namespace skein
