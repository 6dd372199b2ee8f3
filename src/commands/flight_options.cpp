// SPDX-License-Identifier: Apache-2.0
#include "src/commands/flight_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>

#include "base/ends_with.h"
#include "base/field_list.h"
#include "base/number_text.h"
#include "envs/task_registry.h"
#include "src/agents/agent_names.h"
#include "src/agents/policy_file.h"
#include "src/commands/aircraft_option.h"
#include "src/commands/threads_option.h"
#include "src/config/aircraft_choice.h"
#include "src/config/conditions.h"
#include "src/config/configuration.h"
#include "src/config/task_file.h"
#include "src/config/usage_error.h"
#include "src/config/whole_number.h"
#include "src/evaluation/flight_file.h"
#include "src/files/output_file.h"
#include "src/files/text_table.h"
#include "src/files/zip_archive.h"
#include "src/replay/acmi_flights.h"
#include "src/run/run_directory.h"
#include "train/policy/policy_parameters.h"

namespace skein {
namespace {

bool IsIn(const std::string& table, const Field& field) {
  return field.key.rfind(table + ".", 0) == 0;
}

/// Why flights by `policies` do not heed the field; empty if they do.
std::string WhyUnheeded(const Field& field, const std::vector<std::string>& policies) {
  if (field.key == "learner.backend") {
    return policies.empty() ? "computes networks, and no policy flies" : "";
  }
  if (IsIn("network", field)) {
    const bool has_untrained = std::count(policies.begin(), policies.end(), kUntrained) > 0;
    return has_untrained ? "" : "is of untrained networks, and none fly: a policy brings its own";
  }
  if (IsIn("env", field) && !field.is_training_only) return "";
  return "is for trainings and changes no flight";
}

/// Throws UsageError on a key of --set that flights by `policies` do not heed. Files say more than
/// flights: what a run was trained with.
void RequireHeeded(const std::vector<std::string>& assignments,
                   const std::vector<std::string>& policies) {
  ProgramConfig any;
  const std::vector<Field> fields = FieldsOf(any);
  for (const std::string& assignment : assignments) {
    const std::string key = KeyOf(assignment);
    for (const Field& field : fields) {
      if (field.key != key) continue;
      const std::string why = WhyUnheeded(field, policies);
      if (!why.empty()) throw UsageError(fmt::format("--set {}: {}", assignment, why));
    }
  }
}

/// Throws UsageError if a mission of evaluations is over before a target could count.
void RequireRoomForTargets(const EnvConfig& env) {
  const MissionConfig& mission = env.mission;
  if (MakeTask(env)->is_point() || mission.length_s >= mission.dwell_s) return;
  throw UsageError(
      fmt::format("--mission: {} s are too short for any target, which counts after {} s "
                  "(env.mission.dwell_s); the option takes minutes",
                  ShortestText(mission.length_s), ShortestText(mission.dwell_s)));
}

}  // namespace

void AddEnvironmentOptions(CLI::App* command, const FlightOptionTexts& texts,
                           FlightOptions* options) {
  command->add_option("--task", options->task, texts.task)->type_name("TASK");
  options->preset_option =
      command->add_option("--preset", options->preset, texts.preset)->type_name("PRESET");
  command->add_option("--config", options->config, "TOML file on top of them")->type_name("FILE");
  command->add_option("--condition", options->conditions, ConditionHelp())
      ->type_name("NAME=LEVEL")
      ->allow_extra_args(false);
  command
      ->add_option("--set", options->assignments,
                   "one configuration key, such as env.observation_noise=0.03; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void AddEpisodeOptions(CLI::App* command, const FlightOptionTexts& texts, FlightOptions* options) {
  AddEnvironmentOptions(command, texts, options);
  AddAircraftOption(command, &options->aircraft);
  CLI::Option* hold =
      command
          ->add_option("--hold", options->hold_s,
                       "fly on for SECONDS after the target was reached and measure how it is held "
                       "(env.hold_s)")
          ->type_name("SECONDS")
          ->transform(NumberAboveZero());
  command
      ->add_option("--mission", options->mission_min,
                   "fly one target after another for MINUTES; the next comes when one is reached "
                   "or its time limit has passed (sets env.mission.length_s, in s)")
      ->type_name("MINUTES")
      ->transform(NumberAboveZero())
      ->excludes(hold);
  command->add_option("--episodes", options->episodes, "number of episodes")
      ->transform(WholeNumber(1, texts.most_episodes))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "seed of the episodes")
      ->transform(WholeNumber(0, kMostWholeNumber))
      ->capture_default_str();
  AddThreadsOption(command, &options->threads);
}

void AddFlightOptions(CLI::App* command, const FlightOptionTexts& texts, FlightOptions* options) {
  AddEpisodeOptions(command, texts, options);
  AddRankTimeoutOption(command, &options->rank_timeout_s);
  command->add_option("--json", options->json, texts.json)->type_name("FILE");
  CLI::Option* flights =
      command->add_option("--flights", options->flights, texts.flights)->type_name("FILE");
  command
      ->add_option("--acmi", options->acmi,
                   "write the first episodes here for Tacview, as an ACMI file")
      ->type_name("FILE");
  options->flights_count_option = command
                                      ->add_option("--flights-count", options->flights_count,
                                                   "number of episodes that --flights, --acmi and "
                                                   "a page show (all, if there are fewer)")
                                      ->transform(WholeNumber(1, 1000))
                                      ->capture_default_str();
  command
      ->add_flag("--flights-observations", options->flights_observations,
                 "write what the policy observed, too (22 columns of a built-in task)")
      ->needs(flights);
}

CLI::Option* AddAgentList(CLI::App* command, const std::string& description,
                          std::vector<std::string>* agents) {
  const auto take = [agents](const std::vector<std::string>& lists) {
    agents->clear();
    for (const std::string& list : lists) {
      const std::vector<std::string> names = AgentsIn(list);
      agents->insert(agents->end(), names.begin(), names.end());
    }
  };
  return command
      ->add_option_function<std::vector<std::string>>(
          "--agents", take, fmt::format("{}: {}", description, AgentNames()))
      ->type_name("AGENT,...");
}

std::vector<std::string> FilesRead(const FlightOptions& options) {
  std::vector<std::string> files = AircraftFilesIn(options.aircraft, options.assignments);
  std::vector<std::string> settings;
  if (!options.config.empty()) settings.push_back(options.config);
  if (IsTaskFile(options.task)) settings.push_back(options.task);
  for (const std::string& file : settings) {
    files.push_back(file);
    files.push_back(AsUsage([&] { return AircraftFileNamedIn(file); }));
  }
  return files;
}

std::optional<RecurrentPolicy> FirstPolicyWithTask(const std::vector<std::string>& agents) {
  for (const std::string& file : PolicyFilesOfAgents(agents)) {
    RecurrentPolicy policy = RecurrentPolicy::Load(file);
    if (!policy.task().empty()) return policy;
  }
  return std::nullopt;
}

std::string AircraftOfRun(const FlightOptions& options, const std::vector<std::string>& agents) {
  if (!options.aircraft.empty()) return "";
  for (const std::string& assignment : options.assignments) {
    if (KeyOf(assignment) == "env.aircraft") return "";
  }
  for (const std::string& agent : agents) {
    const std::string run = RunOfAgent(agent);
    if (!run.empty()) return ReadRecord(run + "/config.toml").train.env.aircraft;
  }
  return "";
}

ConfigSources SourcesFor(const FlightOptions& options, const std::string& policy,
                         const std::optional<RecurrentPolicy>& trained,
                         const std::string& aircraft) {
  const std::string policys_task = trained ? trained->task() : "";
  const std::string& task = options.task.empty() ? policys_task : options.task;
  if (task.empty()) {
    throw UsageError(
        policy.empty() ? "--task is needed: no agent is a policy that says its own"
                       : fmt::format("--task is needed: --policy {} does not say its own", policy));
  }
  ConfigSources sources{task, options.preset, "", {}};
  sources.is_beginning = true;
  if (!options.task.empty() || !trained) return sources;
  sources.task_text = trained->parameters()->task_file;
  EnvConfig own;
  own.aircraft = options.aircraft.empty() ? aircraft : options.aircraft;
  AsUsage([&] { KeepAircraft("", &own); });
  sources.text_aircraft = own.aircraft;
  return sources;
}

ProgramConfig ConfigFor(const FlightOptions& options, const std::string& policy,
                        const std::optional<RecurrentPolicy>& trained,
                        const std::string& aircraft) {
  const bool is_of_run = options.preset_option->count() == 0 && !IsTaskFile(options.task);
  if (IsRunDirectory(policy) && is_of_run) {
    return ReadRecord(policy + "/config.toml");
  }
  const ConfigSources sources = SourcesFor(options, policy, trained, aircraft);
  return AsUsage([&] { return ResolveConfig(sources); });
}

std::vector<std::string> PoliciesAmong(const std::vector<std::string>& agents) {
  std::vector<std::string> policies;
  for (const std::string& agent : agents) {
    const std::string file = PolicyFileOfAgent(agent);
    if (!file.empty()) policies.push_back(file);
  }
  return policies;
}

void ApplyOverrides(const FlightOptions& options, const std::vector<std::string>& policies,
                    const std::string& aircraft, ProgramConfig* config) {
  const CLI::Option* const count = options.flights_count_option;
  const bool counts = RecordsFlights(options) || options.flights_on_page;
  if (count != nullptr && count->count() > 0 && !counts) {
    throw UsageError("--flights-count is for --flights and --acmi");
  }
  RequireHeeded(options.assignments, policies);
  const ProgramConfig base = *config;
  EnvConfig asked = base.train.env;
  if (!options.task.empty() && !IsTaskFile(options.task)) asked.task = options.task;
  *config = AsUsage([&] {
    ProgramConfig flown = WithAircraft(base, [&](ProgramConfig* changed) {
      if (!aircraft.empty()) changed->train.env.aircraft = aircraft;
      if (!options.config.empty()) ApplyTomlFile(options.config, changed);
      if (!options.aircraft.empty()) {
        ApplyConditionsAndAssignments({}, {AircraftAssignment(options.aircraft)}, changed,
                                      "--aircraft");
      }
      ApplyConditionsAndAssignments(options.conditions, {}, changed);
      for (const auto& [option, assignment] : options.own_assignments) {
        ApplyConditionsAndAssignments({}, {assignment}, changed, option);
      }
      ApplyConditionsAndAssignments({}, options.assignments, changed);
      ApplyConditionsAndAssignments({},
                                    FlightLengthAssignments(options.hold_s, options.mission_min),
                                    changed, options.hold_s ? "--hold" : "--mission");
      RequireTask(changed->train.env, asked);
    });
    RequireOwnScale(base, flown);
    if (flown.train.env.aircraft == base.train.env.aircraft) RequireScaleOfTaskFile(flown);
    CheckFlyable(flown.train.env);
    if (options.mission_min) RequireRoomForTargets(EvaluationConfig(flown.train.env));
    return flown;
  });
}

ProgramConfig ConfigOfAgents(const FlightOptions& options, const std::vector<std::string>& agents) {
  const std::string aircraft = AircraftOfRun(options, agents);
  ConfigSources sources = SourcesFor(
      options, "", options.task.empty() ? FirstPolicyWithTask(agents) : std::nullopt, aircraft);
  sources.file = options.config;
  const std::vector<std::string> policies = PoliciesAmong(agents);
  return AsUsage([&] {
    ProgramConfig config = ResolveConfig(sources);
    const EnvConfig asked = config.train.env;
    ApplyOverrides(options, policies, aircraft, &config);
    CheckEachAgentsOwn(config.train.env, asked);
    return config;
  });
}

void WarnOfTargets(const EnvConfig& env, const GivenTargets& given) {
  for (const auto& beyond : {StartsBeyondOwnEnds(env), TargetsBeyondLimits(env, given),
                             AltitudesBeyondTables(env, given), WindsBeyondAirspeed(env)}) {
    for (const std::string& line : beyond) fmt::print(stderr, "warning: {}\n", line);
  }
}

std::vector<NamedAgent> FindAgents(const std::vector<std::string>& names,
                                   const ProgramConfig& config, std::uint64_t seed) {
  std::vector<NamedAgent> agents;
  std::set<std::string> known;
  for (const std::string& name : names) {
    if (!known.insert(name).second) {
      throw UsageError(fmt::format("--agents: {} is there twice", name));
    }
    agents.push_back({name, FindAgent(name, config, seed)});
  }
  return agents;
}

bool RecordsFlights(const FlightOptions& options) {
  return !options.flights.empty() || !options.acmi.empty();
}

std::string LengthOption(const EnvConfig& env) {
  if (EvaluationConfig(env).mission.enabled()) return "--mission";
  return env.hold_s > 0 ? "--hold" : "env.time_limit_steps";
}

AgentFlights RecordFirst(const FlightOptions& options, const std::string& name, const Agent& agent,
                         const EnvConfig& env, WorkerPool& pool) {
  EvaluationOptions evaluation;
  evaluation.episodes = options.episodes;
  evaluation.seed = options.seed;
  evaluation.target = options.target;
  return FlyAndRecord(name, agent, env, evaluation, options.flights_count, pool);
}

void RequireEndings(const FlightOptions& options) {
  RequireEnding(options.json, ".json", "--json writes JSON");
  RequireEnding(options.flights, ".csv", "--flights writes CSV");
  RequireEnding(options.acmi, ".acmi", "--acmi writes ACMI");
}

void WriteFlightsCsv(const FlightOptions& options, const std::string& path,
                     const std::string& manner, const AgentFlights& flown, bool is_default) {
  const std::string name = OutputName(path, is_default);
  WriteFile(path, FlightsCsv(flown.env, flown.flights,
                             options.flights_observations ? FlightColumns::kStatesAndObservations
                                                          : FlightColumns::kStates));
  fmt::print("{}: {} {}\n", name, Counted(static_cast<int>(flown.flights.size()), "flight"),
             manner);
}

AcmiRecording AcmiOf(const FlightOptions& options, const std::vector<AgentFlights>& agents) {
  const EnvConfig& env = agents.front().env;
  std::vector<std::string> names;
  for (const AgentFlights& flown : agents) names.push_back(flown.agent);
  return RecordAcmi(agents, fmt::format("{}: {}", env.task, fmt::join(names, ", ")),
                    fmt::format("{}; seed {}", DescribeEvaluation(env), options.seed));
}

void WriteFlightsAcmi(const FlightOptions& options, const std::string& path,
                      const std::vector<AgentFlights>& agents) {
  const std::string file = AcmiFile(AcmiOf(options, agents));
  WriteFile(path, EndsWith(path, ".zip.acmi") ? ZipArchive("flights.txt.acmi", file) : file);
  fmt::print("{}: {} by {}, for Tacview\n", path,
             Counted(static_cast<int>(agents.front().flights.size()), "episode"),
             Counted(static_cast<int>(agents.size()), "agent"));
}

std::string PathOfAgent(const std::string& path, const std::string& agent) {
  const std::filesystem::path file(path);
  return (file.parent_path() /
          (file.stem().string() + "." + FileNamePart(agent) + file.extension().string()))
      .string();
}

}  // namespace skein
