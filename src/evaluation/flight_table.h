// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "base/worker_pool.h"
#include "envs/env_config.h"
#include "envs/tasks/task.h"
#include "train/policy/agent.h"
#include "train/policy/record_flights.h"

namespace skein {

enum class FlightColumns { kStates, kStatesAndObservations };

/// One recorded flight in feet, seconds and degrees: a row at time 0 and one at the end of each
/// control step, under the names of docs/reference/file-formats.md.
struct FlightTable {
  std::vector<std::string> names;            ///< of the columns; the first is time_s
  std::vector<std::vector<double>> columns;  ///< [name][row]; NaN where there is no number
  std::vector<Termination> terminations;     ///< [row]; kNone but in the last

  std::size_t rows() const { return terminations.size(); }
  /// Throws Error if there is no such column.
  const std::vector<double>& Column(const std::string& name) const;
  bool Has(const std::string& name) const;
};

/// Of a flight that was recorded in `env`, the agent's own environment.
FlightTable TableOf(const EnvConfig& env, const RecordedFlight& flight,
                    FlightColumns columns = FlightColumns::kStates);

/// How one agent flew the first episodes.
struct AgentFlights {
  std::string agent;                    ///< its name
  EnvConfig env;                        ///< its own environment
  std::vector<TargetQuantity> targets;  ///< what the task compares, with tolerances
  std::vector<RecordedFlight> flights;  ///< by episode
};

/// RecordFlights of the agent `name` in `env`, its own environment (Agent::EnvironmentFor).
AgentFlights FlyAndRecord(const std::string& name, const Agent& agent, const EnvConfig& env,
                          const EvaluationOptions& options, int count, WorkerPool& pool);

}  // namespace skein
