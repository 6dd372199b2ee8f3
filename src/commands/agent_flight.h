// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>

#include "src/commands/flight_condition.h"
#include "src/commands/flown_agents.h"

namespace skein {

/// What `skein fdm fly` is asked when agents fly, beside who (FlownAgents).
struct AgentFlight {
  const FlightCondition& condition;
  const Eigen::Vector3d* wind_ft_s;  ///< null: as the environment has it
  double seconds;
  std::string out;
  bool out_is_default;  ///< nobody asked for a file of that name
};

/// Adds who flies (AddAgents), in what environment (AddEnvironmentOptions), and --target; `flown`
/// must live as long as the command.
void AddAgentsOfFly(CLI::App* command, FlownAgents* flown);

/// Throws UsageError if one of their options was given and nobody of them flies.
void RequireNoAgentOptions(const CLI::App& command);

/// Flies the environment's aircraft, from level flight at the condition, by each agent, writes the
/// flights as CSV, and says where they led. What `command` was given of the condition, the wind and
/// the steps is set in the environment; what it was not is as there. Throws UsageError of what an
/// environment cannot begin in, and of an output that is called as another format than CSV
/// (RequireEnding).
void FlyAgents(const CLI::App& command, const AgentFlight& flight, FlownAgents flown);

}  // namespace skein
