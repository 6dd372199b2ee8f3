// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "base/ends_with.h"
#include "base/fnv_hash.h"
#include "base/nearest_name.h"
#include "src/agents/agent_names.h"
#include "src/agents/low_level_option.h"
#include "src/agents/policy_file.h"
#include "src/bench/machine.h"
#include "src/commands/commands.h"
#include "src/commands/flight_options.h"
#include "src/commands/launched_ranks.h"
#include "src/config/conditions.h"
#include "src/config/presets.h"
#include "src/config/usage_error.h"
#include "src/evaluation/evaluation_report.h"
#include "src/evaluation/recording_limit.h"
#include "src/files/output_file.h"
#include "src/files/text_table.h"
#include "train/files/tensor_file.h"
#include "train/policy/other_aircraft.h"
#include "train/policy/policy_parameters.h"
#include "train/ranks/collectives.h"

namespace skein {
namespace {

struct EvalOptions {
  std::string policy;
  std::string low_level;
  bool sampled = false;
  bool other_aircraft = false;
  FlightOptions flight;
  std::vector<const CLI::Option*> of_policies;  ///< what other agents cannot do
};

std::string Rate(const EnvConfig& env) {
  if (env.action_repeat == 1) return "an action every control step";
  return fmt::format("an action every {} control steps", env.action_repeat);
}

std::string Rates(const RecurrentPolicy& policy, const EnvConfig& env) {
  std::string own = Rate(env);
  if (policy.low_level() == nullptr) return own;
  // It acts anew with every policy step of the high-level policy, too.
  return fmt::format("{} for a low-level policy with one every {}", own,
                     std::min(env.action_repeat, policy.low_level()->action_repeat()));
}

void WriteRecords(const FlightOptions& flight, const std::string& manner,
                  const AgentFlights& flown) {
  if (!flight.flights.empty()) WriteFlightsCsv(flight, flight.flights, manner, flown);
  if (!flight.acmi.empty()) WriteFlightsAcmi(flight, flight.acmi, {flown});
}

/// Throws UsageError on a policy that is called as an agent of `skein compare`, or nearly as one.
void RefuseNearAgentNames(const std::string& policy) {
  if (IsPolicyThere(policy)) return;
  if (const std::string file = PolicyFileOfAgent(policy); !file.empty()) {
    throw UsageError(fmt::format("--policy {}: it takes the file or run alone: {}", policy, file));
  }
  for (const char* option : {"sampled", "other-aircraft"}) {
    if (!EndsWith(policy, std::string("@") + option)) continue;
    throw UsageError(fmt::format("--policy {}: it takes the file or run alone; --{} says the rest",
                                 policy, option));
  }
  const std::string near = DidYouMean(policy, {"autopilot", "random", "zero", kUntrained});
  if (!near.empty()) throw UsageError(fmt::format("--policy {}: no such file{}", policy, near));
}

/// Who is flown, and where.
struct Subject {
  std::string name;  ///< the policy's file, or the agent's name
  ProgramConfig config;
  std::optional<RecurrentPolicy> policy;  ///< nothing: another agent
  Agent agent;                            ///< of a policy that of the mode that is reported first
};

Subject FindOtherAgent(const EvalOptions& options) {
  const FlightOptions& flight = options.flight;
  for (const CLI::Option* option : options.of_policies) {
    if (option->count() == 0) continue;
    throw UsageError(
        fmt::format("{} is for policies, not for --policy {}", option->get_name(), options.policy));
  }
  ProgramConfig config = ConfigOfAgents(flight, {options.policy});
  const Agent agent = FindAgent(options.policy, config, flight.seed);
  config.train.env = agent.EnvironmentFor(config.train.env);
  return {options.policy, config, std::nullopt, agent};
}

Subject FindPolicy(const EvalOptions& options) {
  const FlightOptions& flight = options.flight;
  RefuseNearAgentNames(options.policy);
  const std::string path = PolicyFileOf(options.policy);
  if (path != kUntrained && !options.low_level.empty()) {
    throw UsageError(
        "--low-level is for --policy untrained: a trained high-level policy brings its own");
  }
  std::optional<RecurrentPolicy> trained;
  if (path != kUntrained) trained = RecurrentPolicy::Load(path);
  const std::string aircraft =
      options.other_aircraft ? "" : AircraftOfRun(flight, {"policy:" + options.policy});
  ProgramConfig config = ConfigFor(flight, options.policy, trained, aircraft);
  if (trained) config.train.env = trained->EnvironmentFor(config.train.env);
  ApplyOverrides(flight, {path}, aircraft, &config);
  std::shared_ptr<const StoredPolicy> low_level;
  if (!options.low_level.empty()) {
    config.train.env.tracking.acts_directly = false;  // whatever the preset trains
    low_level = ChooseLowLevelPolicy(config.train.env, options.low_level).policy;
  }
  RecurrentPolicy policy = LoadPolicy(path, config, flight.seed, low_level);
  if (options.other_aircraft) policy = ForAnyAircraft(policy);
  const Agent first = options.sampled ? Agent::SamplingFrom(policy) : Agent::MeanOf(policy);
  return {path, config, policy, first};
}

std::vector<std::string> Inputs(const EvalOptions& options) {
  std::vector<std::string> files = FilesRead(options.flight);
  const std::string policy = IsOtherAgent(options.policy) ? "" : options.policy;
  const std::string low_level = IsAutopilot(options.low_level) ? "" : options.low_level;
  for (const auto& policies : {FilesOfPolicy(policy), FilesOfPolicy(low_level)}) {
    files.insert(files.end(), policies.begin(), policies.end());
  }
  return files;
}

/// What is flown, in short.
std::string Identity(const Subject& subject, const FlightOptions& flight) {
  std::string agent = "agent " + subject.name;
  if (subject.policy) {
    TensorFile policy;
    StorePolicy(*subject.policy->parameters(), policy);
    agent = "policy " + HexHash(policy.Bytes());
  }
  return fmt::format("{}, {}, environment {}, {} episodes of seed {}", DescribeProgram(), agent,
                     HexHash(EnvironmentJson(subject.config).dump()), flight.episodes, flight.seed);
}

/// On all ranks together: flies the episodes; rank 0 says what came of them.
void Report(const EvalOptions& options, const Subject& subject, WorkerPool& pool, Ranks& ranks) {
  const FlightOptions& flight = options.flight;
  const auto& [name, config, policy, agent] = subject;
  const EnvConfig& env = config.train.env;
  std::string lines = InLines("  ", DescribeEvaluation(env)), text;
  nlohmann::ordered_json json;
  if (policy) {
    const EvaluationReport report =
        EvaluateBothWays(*policy, env, flight.episodes, flight.seed, pool, ranks);
    lines += fmt::format("\n  {}\n  {}", Rates(*policy, env), Describe(policy->backend()));
    text = ToText(report, !options.sampled);
    json = ToJson(report, name, config, flight.seed, !options.sampled);
  } else {
    const FlightSummary summary =
        EvaluateAgent(agent, env, flight.episodes, flight.seed, pool, ranks);
    lines += "\n  " + Rate(env);
    text = ToText(summary);
    json = ToJson(summary, name, config, flight.seed);
  }
  if (ranks.rank() != 0) return;
  fmt::print("{} on {}, {}, seed {}\n{}\n  {}\n{}\n", name, env.task,
             Counted(flight.episodes, "episode"), flight.seed, lines, DescribeWorkers(pool), text);
  if (flight.json.empty()) return;
  json["program"] = ProgramJson();
  WriteJson(flight.json, json);
}

/// On all ranks together.
void Evaluate(const EvalOptions& options, Ranks& ranks) {
  const FlightOptions& flight = options.flight;
  std::optional<Subject> subject;
  std::string identity;
  DoTogether(ranks, [&] {
    subject.emplace(IsOtherAgent(options.policy) ? FindOtherAgent(options) : FindPolicy(options));
    if (RecordsFlights(flight)) {
      const EnvConfig& env = subject->config.train.env;
      RequireRoomFor(std::min(flight.flights_count, flight.episodes), 1, LongestFlight(env), env,
                     "--flights-count or " + LengthOption(env));
    }
    if (ranks.rank() == 0) {
      CheckWritable({flight.json, flight.flights, flight.acmi}, Inputs(options));
      RequireEndings(flight);
      WarnOfTargets(subject->config.train.env);
    }
    if (ranks.count() > 1) identity = Identity(*subject, flight);
  });
  RequireSameOnRanks(ranks, "what they fly", identity);
  WorkerPool pool(flight.threads);
  Report(options, *subject, pool, ranks);
  if (ranks.rank() != 0 || !RecordsFlights(flight)) return;
  const auto& [name, config, policy, agent] = *subject;
  const EnvConfig& env = config.train.env;
  if (policy) {
    WriteRecords(flight, options.sampled ? "with sampled actions" : "with the mean action",
                 RecordFirst(flight, "policy:" + name, agent, env, pool));
  } else {
    WriteRecords(flight, "by " + name, RecordFirst(flight, name, agent, env, pool));
  }
}

}  // namespace

void AddEvalCommand(CLI::App* app) {
  auto options = std::make_shared<EvalOptions>();
  CLI::App* command =
      app->add_subcommand("eval", "Fly a policy, or another agent, over fresh episodes");
  command
      ->add_option("--policy", options->policy,
                   "policy file, checkpoint, directory of a run (its best policy), the word "
                   "untrained (freshly initialised networks), or who else flies: " +
                       OtherAgentNames())
      ->type_name("FILE_OR_RUN")
      ->required();
  FlightOptionTexts texts;
  texts.task = TaskHelp() + " (default: the task of the run or of the policy file)";
  texts.preset =
      "environment settings to begin with (default: the run's own; for a policy file, default)";
  texts.json = "write the results here";
  texts.flights =
      "write the first episodes here, a CSV row for every control step, for skein plot "
      "(by mean actions, with --sampled by sampled ones)";
  AddFlightOptions(command, texts, &options->flight);
  const CLI::Option* const low_level =
      command
          ->add_option(
              "--low-level", options->low_level,
              "with --policy untrained: the policy of task control, or autopilot[:VARIANT] "
              "(autopilot means autopilot:aggressive) that is the low-level policy; without it "
              "the policy flies itself")
          ->type_name("RUN_OR_POLICY");
  const CLI::Option* const other_aircraft =
      command->add_flag("--other-aircraft", options->other_aircraft,
                        "fly the policy even if it was trained on another aircraft");
  CLI::Option* const sampled =
      command->add_flag("--sampled", options->sampled,
                        "report sampled actions first (default: mean actions; both are flown)");
  const CLI::Option* const deterministic =
      command->add_flag("--deterministic", "report mean actions first, as is the default")
          ->excludes(sampled);
  options->of_policies = {low_level, other_aircraft, sampled, deterministic};
  command->footer(
      "A policy file knows for how many control steps it holds an action; --set "
      "env.action_repeat=N\n"
      "flies it at another rate. Success counts episodes that reach the target.\n"
      "Example: skein eval --policy runs/short --task heading --episodes 1000 "
      "--json result.json\n"
      "         skein eval --policy runs/short --flights flights.csv\n"
      "         skein eval --policy autopilot --task heading --hold 30\n"
      "         skein eval --policy runs/short --condition windy=60fps,moderate --condition "
      "noisy=0.03");
  command->callback([options] {
    OnLaunchedRanks(options->flight.rank_timeout_s,
                    [&](Ranks& ranks) { Evaluate(*options, ranks); });
  });
}

}  // namespace skein
