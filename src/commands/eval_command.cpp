// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/fnv_hash.h"
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
};

std::string Rates(const RecurrentPolicy& policy, const EnvConfig& env) {
  std::string own = fmt::format("an action every {} control steps", env.action_repeat);
  if (policy.low_level() == nullptr) return own;
  // It acts anew with every policy step of the high-level policy, too.
  return fmt::format("{} for a low-level policy with one every {}", own,
                     std::min(env.action_repeat, policy.low_level()->action_repeat()));
}

/// Of the mode that is reported first.
void WriteRecords(const EvalOptions& options, const std::string& path,
                  const RecurrentPolicy& policy, const EnvConfig& env, WorkerPool& pool) {
  const FlightOptions& flight = options.flight;
  const AgentFlights flown =
      RecordFirst(flight, "policy:" + path,
                  options.sampled ? Agent::SamplingFrom(policy) : Agent::MeanOf(policy), env, pool);
  if (!flight.flights.empty()) {
    WriteFlightsCsv(flight, flight.flights,
                    options.sampled ? "with sampled actions" : "with the mean action", flown);
  }
  if (!flight.acmi.empty()) WriteFlightsAcmi(flight, flight.acmi, {flown});
}

/// Throws UsageError if `policy` is no file, but the name of an agent of `skein compare`.
void RefuseAgentNames(const std::string& policy) {
  std::error_code failure;
  if (!IsAgentName(policy) || std::filesystem::exists(policy, failure)) return;
  if (const std::string file = PolicyFileOfAgent(policy); !file.empty()) {
    throw UsageError(fmt::format("--policy {}: it takes the file or run alone: {}", policy, file));
  }
  throw UsageError(
      fmt::format("--policy {}: eval measures one policy, by its file or run; skein compare "
                  "--agents {} flies other agents, too",
                  policy, policy));
}

/// The policy that is flown, and where.
struct Subject {
  std::string path;
  ProgramConfig config;
  RecurrentPolicy policy;
};

Subject FindSubject(const EvalOptions& options) {
  const FlightOptions& flight = options.flight;
  RefuseAgentNames(options.policy);
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
  return {path, config, policy};
}

std::vector<std::string> Inputs(const EvalOptions& options) {
  std::vector<std::string> files = FilesRead(options.flight);
  const std::string low_level = IsAutopilot(options.low_level) ? "" : options.low_level;
  for (const auto& policies : {FilesOfPolicy(options.policy), FilesOfPolicy(low_level)}) {
    files.insert(files.end(), policies.begin(), policies.end());
  }
  return files;
}

/// What is flown, in short.
std::string Identity(const Subject& subject, const FlightOptions& flight) {
  TensorFile policy;
  StorePolicy(*subject.policy.parameters(), policy);
  return fmt::format("{}, policy {}, environment {}, {} episodes of seed {}", DescribeProgram(),
                     HexHash(policy.Bytes()), HexHash(EnvironmentJson(subject.config).dump()),
                     flight.episodes, flight.seed);
}

/// On all ranks together.
void Evaluate(const EvalOptions& options, Ranks& ranks) {
  const FlightOptions& flight = options.flight;
  std::optional<Subject> subject;
  std::string identity;
  DoTogether(ranks, [&] {
    subject.emplace(FindSubject(options));
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
  const auto& [path, config, policy] = *subject;
  const EnvConfig& env = config.train.env;
  WorkerPool pool(flight.threads);
  const EvaluationReport report =
      EvaluateBothWays(policy, env, flight.episodes, flight.seed, pool, ranks);
  if (ranks.rank() != 0) return;
  fmt::print("{} on {}, {}, seed {}\n{}\n  {}\n  {}\n  {}\n{}\n", path, env.task,
             Counted(flight.episodes, "episode"), flight.seed,
             InLines("  ", DescribeEvaluation(env)), Rates(policy, env), Describe(policy.backend()),
             DescribeWorkers(pool), ToText(report, !options.sampled));
  if (!flight.json.empty()) {
    nlohmann::ordered_json json = ToJson(report, path, config, flight.seed, !options.sampled);
    json["program"] = ProgramJson();
    WriteJson(flight.json, json);
  }
  if (RecordsFlights(flight)) WriteRecords(options, path, policy, env, pool);
}

}  // namespace

void AddEvalCommand(CLI::App* app) {
  auto options = std::make_shared<EvalOptions>();
  CLI::App* command = app->add_subcommand("eval", "Fly a policy over fresh episodes");
  command
      ->add_option("--policy", options->policy,
                   "policy file, checkpoint, directory of a run (its best policy), or the word "
                   "untrained (freshly initialised networks)")
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
  command
      ->add_option(
          "--low-level", options->low_level,
          "with --policy untrained: the policy of task control, or autopilot[:VARIANT] "
          "(autopilot means autopilot:aggressive) that is the low-level policy; without it "
          "the policy flies itself")
      ->type_name("RUN_OR_POLICY");
  command->add_flag("--other-aircraft", options->other_aircraft,
                    "fly the policy even if it was trained on another aircraft");
  CLI::Option* const sampled =
      command->add_flag("--sampled", options->sampled,
                        "report sampled actions first (default: mean actions; both are flown)");
  command->add_flag("--deterministic", "report mean actions first, as is the default")
      ->excludes(sampled);
  command->footer(
      "A policy file knows for how many control steps it holds an action; --set "
      "env.action_repeat=N\n"
      "flies it at another rate. Success counts episodes that reach the target.\n"
      "Example: skein eval --policy runs/short --task heading --episodes 1000 "
      "--json result.json\n"
      "         skein eval --policy runs/short --flights flights.csv\n"
      "         skein eval --policy runs/short --condition windy=60fps,moderate --condition "
      "noisy=0.03");
  command->callback([options] {
    OnLaunchedRanks(options->flight.rank_timeout_s,
                    [&](Ranks& ranks) { Evaluate(*options, ranks); });
  });
}

}  // namespace skein
