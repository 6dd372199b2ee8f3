// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "src/commands/flight_options.h"

namespace skein {

/// Who flies the first episodes, for skein replay, plot and fdm fly.
struct FlownAgents {
  std::string policy;               ///< empty: none
  std::vector<std::string> agents;  ///< beside it
  FlightOptions flight;
  std::optional<double> seconds;     ///< the first of each flight, which reached targets do not end
  std::vector<std::string> targets;  ///< NAME=VALUE, in the place of what is drawn
};

inline constexpr int kMostRecordedEpisodes = 1000;

/// Adds --policy and --agents; `flown` must live as long as the command.
void AddAgents(CLI::App* command, FlownAgents* flown);
/// And the task's help, for AddEpisodeOptions and AddEnvironmentOptions.
FlightOptionTexts TextsOfFlownAgents();
/// Adds --policy, --agents and what AddEpisodeOptions adds; `flown` must live as long as the
/// command.
void AddFlownAgents(CLI::App* command, FlownAgents* flown);

/// Throws UsageError if one of the command's `options`, which are of agents, was given where none
/// flies.
void RequireNotGiven(const CLI::App& command, std::initializer_list<const char*> options);

/// The policy's name and the agents'. Throws UsageError if nobody flies.
std::vector<std::string> NamesOf(const FlownAgents& flown);

/// The files that FlyEpisodes reads. Throws UsageError if nobody flies.
std::vector<std::string> FilesRead(const FlownAgents& flown);

/// The task that FlyEpisodes flies. Throws UsageError if nothing says one.
std::string TaskOf(const FlownAgents& flown);

/// The configuration that FlyEpisodes flies in. Throws UsageError on what cannot be.
ProgramConfig ConfigurationOf(const FlownAgents& flown);

/// The same episodes, flown by everybody in the environment of the policy's run, else of the preset
/// of the task, with the changes that were asked for. Throws UsageError on what cannot be, and on
/// more than kMostRecordedSteps.
std::vector<AgentFlights> FlyEpisodes(const FlownAgents& flown);

}  // namespace skein
