// SPDX-License-Identifier: Apache-2.0
#include "src/commands/flown_agents.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/field_list.h"
#include "base/number_text.h"
#include "envs/aircraft/aircraft.h"
#include "envs/initial_config.h"
#include "envs/task_registry.h"
#include "src/agents/agent_names.h"
#include "src/agents/policy_file.h"
#include "src/config/presets.h"
#include "src/config/usage_error.h"
#include "src/config/whole_number.h"
#include "src/evaluation/comparison.h"
#include "src/evaluation/recording_limit.h"

namespace skein {
namespace {

long StepsOf(double seconds, const EnvConfig& env) {
  return std::lround(seconds / env.control_interval_s);
}

/// Neither the time limit nor a reached target ends an episode before. A mission, which goes on
/// from target to target, holds none.
void GoOnFor(double seconds, EnvConfig* env) {
  const long steps = StepsOf(seconds, *env);
  env->time_limit_steps = std::max(env->time_limit_steps, static_cast<int>(steps));
  const bool is_mission = EvaluationConfig(*env).mission.enabled();
  if (!MakeTask(*env)->is_point() && !is_mission) env->hold_s = std::max(env->hold_s, seconds);
}

/// Where a target of that name may lie.
Bounds BoundsOf(const std::string& name) {
  constexpr double kFarthest = 1e7;  // of lengths in float32, where a foot is a foot
  if (name == "pitch_deg") return {-90, 90};
  // As where flights may begin.
  if (name == "altitude_ft") return {0, kHighestStartFt};
  if (name == "true_airspeed_fps") return {kSlowestStartFps, kFastestStartFps};
  return {-kFarthest, kFarthest};
}

/// What is given of the target `name` as `text`, "NAME=VALUE".
double ValueOf(const std::string& text, const std::string& name) {
  const std::size_t equals = text.find('=');
  const std::optional<double> value =
      equals == std::string::npos ? std::nullopt : ReadNumber(text.substr(equals + 1));
  if (!value || !std::isfinite(*value)) {
    throw UsageError(fmt::format("--target {}: give {}=NUMBER", text, name));
  }
  const Bounds bounds = BoundsOf(name);
  if (!bounds.Contains(*value)) {
    throw UsageError(fmt::format("--target {}: give a number from {} to {}", text,
                                 ShortestText(bounds.min), ShortestText(bounds.max)));
  }
  return *value;
}

/// Of texts in the units of people, in those of the task.
std::vector<std::optional<float>> TargetOf(const std::vector<std::string>& texts,
                                           const EnvConfig& env) {
  if (texts.empty()) return {};
  const std::vector<TargetQuantity> quantities = MakeTask(env)->target_quantities();
  std::vector<std::string> known;
  for (const TargetQuantity& quantity : quantities) known.emplace_back(quantity.column);
  std::vector<std::optional<float>> target(quantities.size());
  for (const std::string& text : texts) {
    const auto found = std::find(known.begin(), known.end(), text.substr(0, text.find('=')));
    if (found == known.end()) {
      throw UsageError(
          fmt::format("--target {}: targets of {} are {}", text, env.task, fmt::join(known, ", ")));
    }
    const auto index = static_cast<std::size_t>(found - known.begin());
    if (target[index]) throw UsageError(fmt::format("--target {}: it is there twice", *found));
    const double value = ValueOf(text, *found);
    target[index] = static_cast<float>(
        quantities[index].is_angle ? std::remainder(value, 360.0) / kDegPerRad : value);
  }
  return target;
}

/// Of texts that TargetOf takes.
GivenTargets GivenBy(const std::vector<std::string>& texts) {
  GivenTargets given;
  for (const std::string& text : texts) {
    const std::string name = text.substr(0, text.find('='));
    given.emplace(name, ValueOf(text, name));
  }
  return given;
}

ProgramConfig Configure(const FlownAgents& flown, const std::vector<std::string>& names) {
  const std::string aircraft = AircraftOfRun(flown.flight, names);
  ProgramConfig config =
      ConfigFor(flown.flight, flown.policy, FirstPolicyWithTask(names), aircraft);
  const EnvConfig asked = config.train.env;
  ApplyOverrides(flown.flight, PoliciesAmong(names), aircraft, &config);
  AsUsage([&] { CheckEachAgentsOwn(config.train.env, asked); });
  EnvConfig& env = config.train.env;
  RequireRoomFor(flown.flight.episodes, names.size(),
                 flown.seconds ? *flown.seconds : LongestFlight(env), env,
                 flown.seconds ? "--seconds" : "--episodes or " + LengthOption(env));
  if (flown.seconds) GoOnFor(*flown.seconds, &env);
  return config;
}

}  // namespace

void AddAgents(CLI::App* command, FlownAgents* flown) {
  command
      ->add_option("--policy", flown->policy,
                   "policy file, checkpoint or directory of a run, whose environment is flown in")
      ->type_name("FILE_OR_RUN");
  AddAgentList(command, "who flies the same episodes, beside it or instead", &flown->agents);
}

FlightOptionTexts TextsOfFlownAgents() {
  FlightOptionTexts texts;
  texts.task = TaskHelp() + " (default: the task of the run or of a policy)";
  texts.preset =
      "environment settings to begin with (default: the run's own; without one, default)";
  texts.most_episodes = kMostRecordedEpisodes;
  return texts;
}

void AddFlownAgents(CLI::App* command, FlownAgents* flown) {
  AddAgents(command, flown);
  AddEpisodeOptions(command, TextsOfFlownAgents(), &flown->flight);
}

void RequireNotGiven(const CLI::App& command, std::initializer_list<const char*> options) {
  for (const char* option : options) {
    if (command.get_option(option)->count() == 0) continue;
    throw UsageError(fmt::format("{} is for --policy and --agents", option));
  }
}

std::vector<std::string> NamesOf(const FlownAgents& flown) {
  std::vector<std::string> names;
  if (!flown.policy.empty()) names.push_back("policy:" + flown.policy);
  names.insert(names.end(), flown.agents.begin(), flown.agents.end());
  if (names.empty()) throw UsageError("--policy or --agents is needed: who flies?");
  return names;
}

std::vector<std::string> FilesRead(const FlownAgents& flown) {
  std::vector<std::string> files = FilesRead(flown.flight);
  const std::vector<std::string> names = NamesOf(flown);
  for (const auto& policies :
       {FilesOfPolicy(flown.policy), PolicyFilesOfAgents(names), FilesOfRunsOfAgents(names)}) {
    files.insert(files.end(), policies.begin(), policies.end());
  }
  return files;
}

std::string TaskOf(const FlownAgents& flown) {
  const std::vector<std::string> names = NamesOf(flown);
  const std::string aircraft = AircraftOfRun(flown.flight, names);
  return ConfigFor(flown.flight, flown.policy, FirstPolicyWithTask(names), aircraft).train.env.task;
}

ProgramConfig ConfigurationOf(const FlownAgents& flown) { return Configure(flown, NamesOf(flown)); }

std::vector<AgentFlights> FlyEpisodes(const FlownAgents& flown) {
  FlightOptions flight = flown.flight;
  flight.flights_count = flight.episodes;
  const std::vector<std::string> names = NamesOf(flown);
  const ProgramConfig config = Configure(flown, names);
  flight.target = TargetOf(flown.targets, config.train.env);
  WarnOfTargets(config.train.env, GivenBy(flown.targets));
  WorkerPool pool(flight.threads);
  std::vector<AgentFlights> agents;
  for (const NamedAgent& named : FindAgents(names, config, flight.seed)) {
    agents.push_back(RecordFirst(flight, named.name, named.agent,
                                 named.agent.EnvironmentFor(config.train.env), pool));
    if (!flown.seconds) continue;
    for (RecordedFlight& recorded : agents.back().flights) {
      const auto most = static_cast<std::size_t>(StepsOf(*flown.seconds, config.train.env));
      recorded.steps.resize(std::min(recorded.steps.size(), most));
    }
  }
  return agents;
}

}  // namespace skein
