// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "base/worker_pool.h"
#include "envs/env_config.h"
#include "src/config/program_config.h"
#include "src/evaluation/flight_summary.h"
#include "train/policy/agent.h"
#include "train/policy/recurrent_policy.h"
#include "train/ranks/ranks.h"

namespace skein {

/// One policy flown both ways on the same fresh episodes.
struct EvaluationReport {
  FlightSummary deterministic;  ///< with the mean action
  FlightSummary sampled;        ///< with sampled actions
};

/// On all ranks together: flies `episodes` fresh episodes of `seed`; clocks are not staggered. The
/// same on every rank. Throws as FlyEpisodesOnRanks.
FlightSummary EvaluateAgent(const Agent& agent, const EnvConfig& env, int episodes,
                            std::uint64_t seed, WorkerPool& pool, Ranks& ranks = OneRank());

/// EvaluateAgent with the policy's mean action and with sampled ones.
EvaluationReport EvaluateBothWays(const RecurrentPolicy& policy, const EnvConfig& env, int episodes,
                                  std::uint64_t seed, WorkerPool& pool, Ranks& ranks = OneRank());

/// The document of `skein eval --json` and evaluation.json but for `program` (ProgramJson): policy,
/// task, mode, seed, the keys of FlightSummary for the mode asked for, both modes in full, and the
/// environment's settings.
nlohmann::ordered_json ToJson(const EvaluationReport& report, const std::string& policy,
                              const ProgramConfig& config, std::uint64_t seed, bool deterministic);

/// The same of an agent that flies in one way: agent, task, seed, the keys of FlightSummary, and
/// the environment's settings.
nlohmann::ordered_json ToJson(const FlightSummary& summary, const std::string& agent,
                              const ProgramConfig& config, std::uint64_t seed);

/// Every `env.` key with its value in evaluations (EvaluationConfig).
nlohmann::ordered_json EnvironmentJson(ProgramConfig config);

/// Lines for people, without a newline at the end: both modes, and how the one asked for flew.
std::string ToText(const EvaluationReport& report, bool deterministic);
/// The same of an agent that flies in one way.
std::string ToText(const FlightSummary& summary);

/// The headlines of both modes in a table that fits a screen beside a few more lines, and how the
/// episodes with the mean action ended.
std::string ToSummary(const EvaluationReport& report);

}  // namespace skein
