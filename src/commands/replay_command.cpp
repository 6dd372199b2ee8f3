// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>

#include "base/ends_with.h"
#include "src/commands/commands.h"
#include "src/commands/flown_agents.h"
#include "src/config/one_of.h"
#include "src/config/usage_error.h"
#include "src/config/whole_number.h"
#include "src/files/output_file.h"
#include "src/files/text_table.h"
#include "src/replay/password_hash.h"
#include "src/replay/telemetry_server.h"
#include "src/report/report_data.h"
#include "src/report/report_page.h"
#include "src/run/run_signals.h"

namespace skein {
namespace {

constexpr int kDefaultEpisodes = 8;

struct ReplayOptions {
  FlownAgents flown;
  std::string format, out;
  std::optional<int> live_port;
  TelemetryOptions telemetry;
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
    WriteFlightsCsv(options.flown.flight,
                    is_alone ? options.out : PathOfAgent(options.out, flown.agent),
                    "by " + flown.agent, flown);
  }
}

void WriteAcmi(const ReplayOptions& options, const std::vector<AgentFlights>& agents) {
  WriteFlightsAcmi(options.flown.flight, options.out, agents);
}

void WriteHtml(const ReplayOptions& options, const std::vector<AgentFlights>& agents) {
  WriteReport(options.out, FlightsData(agents, options.flown.flight.seed));
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

void CheckOutputs(const ReplayOptions& options, const std::vector<std::string>& names) {
  if (options.live_port) {
    AsUsage([&] { TelemetryPasswordHashes(options.telemetry.password); });
    return;
  }
  if (options.out.empty()) throw UsageError("-o FILE or --live PORT is needed: where to?");
  std::vector<std::string> paths = {options.out};
  const ReplayFormat& format = ChooseFormat(options);
  if (format.has_file_per_agent && names.size() > 1) {
    paths.clear();
    for (const std::string& name : names) paths.push_back(PathOfAgent(options.out, name));
  }
  CheckWritable(paths, FilesRead(options.flown));
  RequireEnding(options.out, format.ending, fmt::format("--format {}", format.name));
  if (format.write == WriteHtml) ReportTemplate();  // without one there is nothing to fly for
}

void Stream(const ReplayOptions& options, const std::vector<AgentFlights>& agents) {
  WorkerPool pool(1);
  const AcmiRecording recording = AcmiOf(options.flown.flight, agents);
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
  CheckOutputs(options, NamesOf(options.flown));
  const std::vector<AgentFlights> agents = FlyEpisodes(options.flown);
  if (options.live_port) {
    Stream(options, agents);
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
      ->check(OneOf(FormatNames()))
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
  options->flown.flight.episodes = kDefaultEpisodes;
  CLI::App* command = app->add_subcommand(
      "replay", "Fly episodes and write them, for Tacview, as CSV or as a page, or stream them");
  AddFlownAgents(command, &options->flown);
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
  command->callback([options] { Replay(*options); });
}

}  // namespace skein
