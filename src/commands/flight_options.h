// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/commands/launched_ranks.h"
#include "src/config/configuration.h"
#include "src/config/program_config.h"
#include "src/config/target_reach.h"
#include "src/evaluation/comparison.h"
#include "src/evaluation/flight_table.h"
#include "src/replay/acmi_writer.h"
#include "train/policy/recurrent_policy.h"

namespace skein {

/// What the commands that fly episodes have in common: the environment and the episodes.
struct FlightOptions {
  std::string task;
  std::string preset = "default";
  CLI::Option* preset_option = nullptr;
  std::string config;
  std::string aircraft;  ///< empty: what the configuration has
  std::vector<std::string> conditions, assignments;
  std::optional<double> hold_s, mission_min;
  int episodes = 1000;
  std::uint64_t seed = 0;
  int threads = 0;
  double rank_timeout_s = kRankTimeoutS;
  std::string json;
  std::string flights, acmi;
  int flights_count = 8;
  CLI::Option* flights_count_option = nullptr;
  bool flights_observations = false;
  bool flights_on_page = false;  ///< of a report, beside those files
  /// What options of the command alone set, before --set: the option, for errors, and KEY=VALUE.
  std::vector<std::pair<std::string, std::string>> own_assignments;
  std::vector<std::optional<float>> target;  ///< EvaluationOptions::target of recorded flights
};

/// What of their help the commands say differently.
struct FlightOptionTexts {
  std::string task, preset, json, flights;
  double most_episodes = 1e7;
};

/// Adds --task, --preset, --config, --condition and --set to a command; `options` must live as long
/// as it.
void AddEnvironmentOptions(CLI::App* command, const FlightOptionTexts& texts,
                           FlightOptions* options);
/// Adds those, and those of the aircraft and the episodes.
void AddEpisodeOptions(CLI::App* command, const FlightOptionTexts& texts, FlightOptions* options);
/// Adds those, and those of the files that results and flights go to.
void AddFlightOptions(CLI::App* command, const FlightOptionTexts& texts, FlightOptions* options);

/// Adds --agents, a list of names, with blanks around them left out; `description` ends with what
/// they may be.
CLI::Option* AddAgentList(CLI::App* command, const std::string& description,
                          std::vector<std::string>* agents);

/// The files that the options name and that are read: of a configuration, a task, an aircraft.
std::vector<std::string> FilesRead(const FlightOptions& options);

/// The first of these agents that is a policy and says its own task; nothing if none does. Throws
/// Error on a policy that cannot be read.
std::optional<RecurrentPolicy> FirstPolicyWithTask(const std::vector<std::string>& agents);

/// The aircraft of the first of these agents that is the policy of a run (RunOfAgent), as the run
/// has recorded it; empty if none is, or if --aircraft or --set choose the aircraft.
std::string AircraftOfRun(const FlightOptions& options, const std::vector<std::string>& agents);

/// Where the configuration of the task begins that is asked for, else of that of `trained`: at the
/// preset. `aircraft` is AircraftOfRun. Throws UsageError, which names `policy` unless that is
/// empty, if nothing says a task.
ConfigSources SourcesFor(const FlightOptions& options, const std::string& policy,
                         const std::optional<RecurrentPolicy>& trained,
                         const std::string& aircraft);

/// What a policy was made for: the run's own configuration if `policy` is a run and no preset was
/// asked for, else the preset's, of the task of `trained` if no other is asked for.
ProgramConfig ConfigFor(const FlightOptions& options, const std::string& policy,
                        const std::optional<RecurrentPolicy>& trained, const std::string& aircraft);

/// The files of those of these agents that are policies, kUntrained for untrained ones.
std::vector<std::string> PoliciesAmong(const std::vector<std::string>& agents);

/// The environment of `config` with `aircraft` (AircraftOfRun), --config, --aircraft, --condition,
/// --set, --hold and --mission on top. `policies` are those that fly (PoliciesAmong). Throws
/// UsageError if they cannot be, name another task than --task (without it: than `config`), or if
/// --set gives a key that no flight heeds.
void ApplyOverrides(const FlightOptions& options, const std::vector<std::string>& policies,
                    const std::string& aircraft, ProgramConfig* config);

/// The configuration in which all of these agents fly: of --task, else of the first policy among
/// them that says its own, and of --preset, with --config and what ApplyOverrides takes on top.
/// Throws UsageError as that does, and if more than --config changes what every agent has of its
/// own (CheckEachAgentsOwn).
ProgramConfig ConfigOfAgents(const FlightOptions& options, const std::vector<std::string>& agents);

/// Says on the error stream which targets no flight can come to or are of more than a turn
/// (TargetsBeyondLimits), what lies above the engine's tables (AltitudesBeyondTables), and which
/// winds few flights get over (WindsBeyondAirspeed).
void WarnOfTargets(const EnvConfig& env, const GivenTargets& given = {});

/// The agents of a list of --agents, for the environment of `config`. Throws UsageError on a name
/// that is there twice.
std::vector<NamedAgent> FindAgents(const std::vector<std::string>& names,
                                   const ProgramConfig& config, std::uint64_t seed);

/// Whether flights are to be recorded.
bool RecordsFlights(const FlightOptions& options);

/// The option or key that this follows from, for errors.
std::string LengthOption(const EnvConfig& env);

/// The first episodes, as many as --flights-count says.
AgentFlights RecordFirst(const FlightOptions& options, const std::string& name, const Agent& agent,
                         const EnvConfig& env, WorkerPool& pool);

/// As RequireEnding, of --json, --flights and --acmi.
void RequireEndings(const FlightOptions& options);

/// Writes them to `path` as CSV, and says so (OutputName). `manner` is how they were flown.
void WriteFlightsCsv(const FlightOptions& options, const std::string& path,
                     const std::string& manner, const AgentFlights& flown, bool is_default = false);

/// Writes the same episodes by all agents to `path` as an ACMI file, and says so.
void WriteFlightsAcmi(const FlightOptions& options, const std::string& path,
                      const std::vector<AgentFlights>& agents);

/// The ACMI recording of the same episodes by all agents.
AcmiRecording AcmiOf(const FlightOptions& options, const std::vector<AgentFlights>& agents);

/// "flights.csv" of agent "policy:runs/a" is "flights.policy-runs-a.csv".
std::string PathOfAgent(const std::string& path, const std::string& agent);

}  // namespace skein
