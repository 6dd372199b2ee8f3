// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "src/commands/flight_options.h"

namespace skein {

/// Who flies the first episodes, for skein replay and plot.
struct FlownAgents {
  std::string policy;               ///< empty: none
  std::vector<std::string> agents;  ///< beside it
  FlightOptions flight;
};

inline constexpr int kMostRecordedEpisodes = 1000;

/// Adds --policy, --agents and what AddEpisodeOptions adds; `flown` must live as long as the
/// command.
void AddFlownAgents(CLI::App* command, FlownAgents* flown);

/// The policy's name and the agents'. Throws UsageError if nobody flies.
std::vector<std::string> NamesOf(const FlownAgents& flown);

/// The same episodes, flown by everybody in the environment of the policy's run, else of the preset
/// of the task, with the changes that were asked for.
std::vector<AgentFlights> FlyEpisodes(const FlownAgents& flown);

}  // namespace skein
