// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>

#include "src/agents/agent_names.h"
#include "src/agents/policy_file.h"
#include "src/commands/commands.h"
#include "src/commands/flight_options.h"
#include "src/config/presets.h"
#include "src/config/usage_error.h"
#include "src/config/whole_number.h"
#include "src/evaluation/comparison.h"
#include "src/files/output_file.h"
#include "src/files/text_table.h"
#include "src/replay/password_hash.h"
#include "src/replay/telemetry_server.h"
#include "src/report/report_data.h"
#include "src/report/report_page.h"
#include "src/run/run_signals.h"
#include "train/policy/recurrent_policy.h"

namespace skein {
namespace {

constexpr int kDefaultEpisodes = 8, kMostEpisodes = 1000;

struct ReplayOptions {
  std::string policy;
  std::vector<std::string> agents;
  std::string format, out;
  std::optional<int> live_port;
  TelemetryOptions telemetry;
  FlightOptions flight;
};

/// Writes the same episodes by all agents.
struct ReplayFormat {
  const char* name;
  const char* ending;  ///< of files that are of this format if no other is asked for
  bool has_file_per_agent;
  void (*write)(const ReplayOptions& options, const std::vector<AgentFlights>& agents);
};

void WriteCsv(const ReplayOptions& options, const std::vector<AgentFlights>& agents) {
  for (const AgentFlights& flown : agents) {
    const bool is_alone = agents.size() == 1;
    WriteFlightsCsv(options.flight, is_alone ? options.out : PathOfAgent(options.out, flown.agent),
                    "by " + flown.agent, flown);
  }
}

void WriteAcmi(const ReplayOptions& options, const std::vector<AgentFlights>& agents) {
  WriteFlightsAcmi(options.flight, options.out, agents);
}

void WriteHtml(const ReplayOptions& options, const std::vector<AgentFlights>& agents) {
  WriteReport(options.out, FlightsData(agents, options.flight.seed));
  fmt::print("{}: {} by {}, for a browser\n", options.out,
             Counted(static_cast<int>(agents.front().flights.size()), "episode"),
             Counted(static_cast<int>(agents.size()), "agent"));
}

constexpr ReplayFormat kFormats[] = {{"acmi", ".acmi", false, WriteAcmi},
                                     {"csv", ".csv", true, WriteCsv},
                                     {"html", ".html", false, WriteHtml}};

std::vector<std::string> FormatNames() {
  std::vector<std::string> names;
  for (const ReplayFormat& format : kFormats) names.emplace_back(format.name);
  return names;
}

bool EndsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() &&
         text.compare(text.size() - end.size(), std::string::npos, end) == 0;
}

/// The one that was asked for, or the one that the name of the file tells.
const ReplayFormat& ChooseFormat(const ReplayOptions& options) {
  for (const ReplayFormat& format : kFormats) {
    if (options.format.empty() ? EndsWith(options.out, format.ending)
                               : options.format == format.name) {
      return format;
    }
  }
  throw UsageError(fmt::format("--format is needed, one of {}: -o {} does not tell it",
                               fmt::join(FormatNames(), ", "), options.out));
}

std::vector<std::string> NamesOf(const ReplayOptions& options) {
  std::vector<std::string> names;
  if (!options.policy.empty()) names.push_back("policy:" + options.policy);
  names.insert(names.end(), options.agents.begin(), options.agents.end());
  if (names.empty()) throw UsageError("--policy or --agents is needed: who flies?");
  return names;
}

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

ProgramConfig Configure(const ReplayOptions& options, const std::vector<std::string>& names) {
  const FlightOptions& flight = options.flight;
  ProgramConfig config = ConfigFor(flight, options.policy, PolicyOf(names));
  const EnvConfig asked = config.train.env;
  ApplyOverrides(flight, &config);
  AsUsage([&] { CheckEachAgentsOwn(config.train.env, asked); });
  return config;
}

void CheckOutputs(const ReplayOptions& options, const std::vector<std::string>& names) {
  if (options.live_port) {
    AsUsage([&] { TelemetryPasswordHashes(options.telemetry.password); });
    return;
  }
  if (options.out.empty()) throw UsageError("-o FILE or --live PORT is needed: where to?");
  std::vector<std::string> paths = {options.out};
  if (ChooseFormat(options).has_file_per_agent && names.size() > 1) {
    paths.clear();
    for (const std::string& name : names) paths.push_back(PathOfAgent(options.out, name));
  }
  CheckWritable(paths);
}

void Stream(const ReplayOptions& options, const std::vector<AgentFlights>& agents,
            WorkerPool& pool) {
  const AcmiRecording recording = AcmiOf(options.flight, agents);
  TelemetryOptions telemetry = options.telemetry;
  telemetry.port = *options.live_port;
  const RunSignals signals(pool);
  const auto say = [](const std::string& line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
  };
  TelemetryServer server(
      telemetry, [&] { return signals.StopSignal() != 0; }, say);
  say(fmt::format("{} s of flights for Tacview's real-time telemetry on {}:{}; Ctrl-C ends it",
                  AcmiNumber(recording.frames.back().time_s, 1), telemetry.host, server.port()));
  server.Serve(recording);
}

void Replay(const ReplayOptions& options) {
  const FlightOptions& flight = options.flight;
  const std::vector<std::string> names = NamesOf(options);
  CheckOutputs(options, names);
  const ProgramConfig config = Configure(options, names);
  WorkerPool pool(flight.threads);
  std::vector<AgentFlights> agents;
  for (const NamedAgent& named : FindAgents(names, config, flight.seed)) {
    agents.push_back(RecordFirst(flight, named.name, named.agent,
                                 named.agent.EnvironmentFor(config.train.env), pool));
  }
  if (options.live_port) {
    Stream(options, agents, pool);
  } else {
    ChooseFormat(options).write(options, agents);
  }
}

void AddOutputOptions(CLI::App* command, ReplayOptions* options) {
  CLI::Option* out =
      command->add_option("-o,--out", options->out, "write the flights here")->type_name("FILE");
  command
      ->add_option(
          "--format", options->format,
          "acmi, for Tacview: all agents in one file; csv, a row for every control step: "
          "of several agents FILE.csv becomes FILE.AGENT.csv; html, a page that shows them "
          "(default: by the name of the file)")
      ->check(CLI::IsMember(FormatNames()))
      ->needs(out);
  CLI::Option* live =
      command
          ->add_option("--live", options->live_port,
                       "stream the flights by Tacview's real-time telemetry on this port instead "
                       "(Tacview's own is 42674; 0: one that is free)")
          ->transform(WholeNumber(0, 65535))
          ->type_name("PORT")
          ->excludes(out);
  command
      ->add_option("--host", options->telemetry.host,
                   "where --live listens; 0.0.0.0 lets other machines watch")
      ->type_name("ADDRESS")
      ->needs(live)
      ->capture_default_str();
  command
      ->add_option("--password", options->telemetry.password,
                   "what clients of --live have to give; keeps out mistakes, not attackers")
      ->type_name("TEXT")
      ->needs(live);
}

}  // namespace

void AddReplayCommand(CLI::App* app) {
  auto options = std::make_shared<ReplayOptions>();
  options->flight.episodes = kDefaultEpisodes;
  CLI::App* command =
      app->add_subcommand("replay", "Record flights, or stream them, to watch them in Tacview");
  command
      ->add_option("--policy", options->policy,
                   "policy file, checkpoint or directory of a run, whose environment is flown in")
      ->type_name("FILE_OR_RUN");
  command
      ->add_option(
          "--agents", options->agents,
          fmt::format("who flies the same episodes, beside it or instead: {}", AgentNames()))
      ->type_name("AGENT,...")
      ->delimiter(',');
  FlightOptionTexts texts;
  texts.task = fmt::format("what to fly: {} (default: the task of the run or of a policy)",
                           fmt::join(PresetTasks(), ", "));
  texts.preset =
      "environment settings to begin with (default: the run's own; without one, default)";
  AddEpisodeOptions(command, texts, &options->flight);
  command->get_option("--episodes")->check(CLI::Range(1, kMostEpisodes));
  AddOutputOptions(command, options.get());
  command->footer(
      "The episodes are the first that skein eval and compare fly with the same seed; policies fly "
      "with their mean action\n"
      "unless @sampled.\n"
      "Example: skein replay --policy runs/short --episodes 4 -o flights.acmi\n"
      "         skein replay --task heading --agents policy:runs/a,autopilot --condition "
      "windy=hard "
      "-o windy.acmi\n"
      "         skein replay --policy runs/short --live 42674");
  command->callback([options] {
    options->flight.flights_count = options->flight.episodes;
    Replay(*options);
  });
}

}  // namespace skein
