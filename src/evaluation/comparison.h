// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/worker_pool.h"
#include "src/config/program_config.h"
#include "src/evaluation/estimate.h"
#include "src/evaluation/flight_summary.h"
#include "train/policy/agent.h"
#include "train/ranks/ranks.h"

namespace skein {

/// An agent as the command line calls it.
struct NamedAgent {
  std::string name;
  Agent agent;
};

/// How an agent flew beside another one, on the same episodes.
struct PairedDifferences {
  /// This agent's value less the other one's, by the comparison's quantities: over the episodes of
  /// which both have one. NaN of what is no mean or share.
  std::vector<Estimate> estimates;
  double success_p_value = 1;  ///< McNemar's (CompareShares)
};

struct ComparedAgent {
  std::string name;
  int action_repeat = 1;
  FlightSummary summary;
  /// [agent] beside each of those ahead of it in the comparison: of the first agent empty.
  std::vector<PairedDifferences> against;
};

struct Comparison {
  std::string task;
  int episodes = 0;
  std::uint64_t seed = 0;
  double control_interval_s = 0;
  std::string conditions;    ///< DescribeEvaluation
  std::uint64_t starts = 0;  ///< FlownEpisodes::starts, the same for all
  std::vector<Quantity> quantities;
  std::vector<ComparedAgent> agents;
};

/// Throws Error if `env` differs from the one that it was made from in what every agent brings
/// along itself: its rate, and how a high-level policy is shown what it sees.
void CheckEachAgentsOwn(const EnvConfig& env, const EnvConfig& origin);

/// On all ranks together: flies every agent over the same episodes of `config`'s environment, each
/// at its own rate. If the pool is stopping, ends early, and the result says nothing.
Comparison Compare(const std::vector<NamedAgent>& agents, const ProgramConfig& config, int episodes,
                   std::uint64_t seed, WorkerPool& pool, Ranks& ranks = OneRank());

/// A table for people, 100 columns wide, an agent a column; without a newline at the end.
std::string ToText(const Comparison& comparison);

/// A header, and a row for every agent.
std::string ToCsv(const Comparison& comparison);

/// The document of `skein compare --json` but for `program` (ProgramJson). Keys: task, conditions,
/// episodes, seed, starts (hexadecimal), environment, agents: name, action_repeat, the keys of
/// FlightSummary, and but for the first agent against_first (estimates by key, success_p_value) and
/// against (a list of the same beside every agent ahead of it).
nlohmann::ordered_json ToJson(const Comparison& comparison, const ProgramConfig& config);

}  // namespace skein
