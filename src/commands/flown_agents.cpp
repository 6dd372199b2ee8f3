// SPDX-License-Identifier: Apache-2.0
#include "src/commands/flown_agents.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

#include "src/agents/agent_names.h"
#include "src/agents/policy_file.h"
#include "src/config/presets.h"
#include "src/config/usage_error.h"
#include "src/evaluation/comparison.h"
#include "train/policy/recurrent_policy.h"

namespace skein {
namespace {

/// The first agent that is a policy and says its own task.
std::optional<RecurrentPolicy> PolicyOf(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const std::string file = PolicyFileOfAgent(name);
    if (file.empty() || file == kUntrained) continue;
    RecurrentPolicy policy = RecurrentPolicy::Load(file);
    if (!policy.task().empty()) return policy;
  }
  return std::nullopt;
}

ProgramConfig Configure(const FlownAgents& flown, const std::vector<std::string>& names) {
  ProgramConfig config = ConfigFor(flown.flight, flown.policy, PolicyOf(names));
  const EnvConfig asked = config.train.env;
  ApplyOverrides(flown.flight, &config);
  AsUsage([&] { CheckEachAgentsOwn(config.train.env, asked); });
  return config;
}

}  // namespace

void AddFlownAgents(CLI::App* command, FlownAgents* flown) {
  command
      ->add_option("--policy", flown->policy,
                   "policy file, checkpoint or directory of a run, whose environment is flown in")
      ->type_name("FILE_OR_RUN");
  command
      ->add_option(
          "--agents", flown->agents,
          fmt::format("who flies the same episodes, beside it or instead: {}", AgentNames()))
      ->type_name("AGENT,...")
      ->delimiter(',');
  FlightOptionTexts texts;
  texts.task = fmt::format("what to fly: {} (default: the task of the run or of a policy)",
                           fmt::join(PresetTasks(), ", "));
  texts.preset =
      "environment settings to begin with (default: the run's own; without one, default)";
  AddEpisodeOptions(command, texts, &flown->flight);
  command->get_option("--episodes")->check(CLI::Range(1, kMostRecordedEpisodes));
}

std::vector<std::string> NamesOf(const FlownAgents& flown) {
  std::vector<std::string> names;
  if (!flown.policy.empty()) names.push_back("policy:" + flown.policy);
  names.insert(names.end(), flown.agents.begin(), flown.agents.end());
  if (names.empty()) throw UsageError("--policy or --agents is needed: who flies?");
  return names;
}

std::vector<AgentFlights> FlyEpisodes(const FlownAgents& flown) {
  FlightOptions flight = flown.flight;
  flight.flights_count = flight.episodes;
  const std::vector<std::string> names = NamesOf(flown);
  const ProgramConfig config = Configure(flown, names);
  WorkerPool pool(flight.threads);
  std::vector<AgentFlights> agents;
  for (const NamedAgent& named : FindAgents(names, config, flight.seed)) {
    agents.push_back(RecordFirst(flight, named.name, named.agent,
                                 named.agent.EnvironmentFor(config.train.env), pool));
  }
  return agents;
}

}  // namespace skein
