// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <system_error>
#include <utility>

#include "base/choice_error.h"
#include "base/fnv_hash.h"
#include "src/agents/agent_names.h"
#include "src/bench/machine.h"
#include "src/commands/commands.h"
#include "src/commands/flight_options.h"
#include "src/commands/launched_ranks.h"
#include "src/config/configuration.h"
#include "src/config/presets.h"
#include "src/config/usage_error.h"
#include "src/evaluation/comparison.h"
#include "src/evaluation/evaluation_report.h"
#include "src/evaluation/recording_limit.h"
#include "src/files/output_file.h"
#include "src/report/report_data.h"
#include "src/report/report_page.h"
#include "src/report/run_report.h"
#include "train/ranks/collectives.h"

namespace skein {
namespace {

namespace fs = std::filesystem;

struct CompareOptions {
  std::vector<std::string> agents;
  std::string csv, html;
  bool no_html = false;
  FlightOptions flight;
};

std::vector<std::string> Inputs(const CompareOptions& options) {
  std::vector<std::string> files = FilesRead(options.flight);
  for (const auto& of_agents :
       {PolicyFilesOfAgents(options.agents), FilesOfRunsOfAgents(options.agents)}) {
    files.insert(files.end(), of_agents.begin(), of_agents.end());
  }
  return files;
}

/// Where the page goes that nobody has asked for.
constexpr const char* kDefaultPage = "compare.html";

bool WritesDefaultPage(const CompareOptions& options) {
  return !options.no_html && options.html.empty() && FindReportTemplate();
}

std::vector<std::string> Outputs(const CompareOptions& options) {
  std::vector<std::string> paths = {options.csv, options.html, options.flight.json,
                                    options.flight.acmi};
  if (options.flight.flights.empty()) return paths;
  for (const std::string& agent : options.agents) {
    paths.push_back(PathOfAgent(options.flight.flights, agent));
  }
  return paths;
}

/// Throws Error where CheckWritable does, and on what the default page would replace. That it has
/// no place is no failure.
void CheckFiles(const CompareOptions& options) {
  const std::vector<std::string> outputs = Outputs(options), inputs = Inputs(options);
  CheckWritable(outputs, inputs);
  RequireEndings(options.flight);
  RequireEnding(options.csv, ".csv", "--csv writes CSV");
  RequireEnding(options.html, ".html", "--html writes a page");
  if (!WritesDefaultPage(options)) return;
  const auto place = [](const std::string& file) {
    std::error_code failure;
    return fs::weakly_canonical(fs::absolute(file, failure), failure);
  };
  const fs::path page = place(kDefaultPage);
  for (const auto* const files : {&outputs, &inputs}) {
    for (const std::string& file : *files) {
      if (file.empty() || page.empty() || place(file) != page) continue;
      throw ChoiceError(std::string(kDefaultPage) +
                        ": the page goes there; give it another place, --html, or --no-html");
    }
  }
}

void WriteRecords(const FlightOptions& flight, const std::vector<NamedAgent>& agents,
                  const EnvConfig& env, WorkerPool& pool) {
  std::vector<AgentFlights> for_acmi;
  for (const NamedAgent& named : agents) {
    AgentFlights flown =
        RecordFirst(flight, named.name, named.agent, named.agent.EnvironmentFor(env), pool);
    if (!flight.flights.empty()) {
      WriteFlightsCsv(flight, PathOfAgent(flight.flights, named.name), "by " + named.name, flown);
    }
    if (!flight.acmi.empty()) for_acmi.push_back(std::move(flown));
  }
  if (!flight.acmi.empty()) WriteFlightsAcmi(flight, flight.acmi, for_acmi);
}

std::string PageData(const CompareOptions& options, const Comparison& comparison,
                     const ProgramConfig& config, const std::vector<NamedAgent>& agents,
                     WorkerPool& pool) {
  std::vector<AgentFlights> flown;
  for (const NamedAgent& named : agents) {
    flown.push_back(RecordFirst(options.flight, named.name, named.agent,
                                named.agent.EnvironmentFor(config.train.env), pool));
  }
  return ComparisonData(comparison, config, flown);
}

/// Throws UsageError if more is to be recorded than has room.
void RequireRoom(const CompareOptions& options, const EnvConfig& env) {
  const FlightOptions& flight = options.flight;
  const bool has_page = !options.html.empty() || WritesDefaultPage(options);
  if (!has_page && !RecordsFlights(flight)) return;
  // Files of single agents are written one after the other.
  const bool keeps_all = has_page || !flight.acmi.empty();
  RequireRoomFor(std::min(flight.flights_count, flight.episodes),
                 keeps_all ? options.agents.size() : 1, LongestFlight(env), env,
                 "--flights-count or " + LengthOption(env) +
                     (has_page && options.html.empty() ? ", or give --no-html" : ""));
}

/// A page that was asked for is written, or the command fails; without being asked one is written
/// where one can be.
void WritePage(const CompareOptions& options, const std::function<std::string()>& data) {
  if (options.no_html) return;
  if (options.html.empty()) {
    WriteReportAtEnd(kDefaultPage, data, true);
    return;
  }
  CheckWritable(options.html);
  WriteReport(options.html, data());
  fmt::print("report          {}\n", options.html);
}

/// What the agents are and what they fly, in short.
std::string Identity(const CompareOptions& options, const ProgramConfig& config) {
  std::string agents;
  for (const std::string& name : options.agents) agents += name + FingerprintOfAgent(name) + "\n";
  const FlightOptions& flight = options.flight;
  return fmt::format("{}, agents {}, environment {}, {} episodes of seed {}", DescribeProgram(),
                     HexHash(agents), HexHash(EnvironmentJson(config).dump()), flight.episodes,
                     flight.seed);
}

void WriteAll(const CompareOptions& options, const Comparison& comparison,
              const ProgramConfig& config, const std::vector<NamedAgent>& agents,
              WorkerPool& pool) {
  const FlightOptions& flight = options.flight;
  if (!options.csv.empty()) {
    WriteFile(options.csv, ToCsv(comparison));
  }
  if (!flight.json.empty()) {
    nlohmann::ordered_json json = ToJson(comparison, config);
    json["program"] = ProgramJson();
    WriteJson(flight.json, json);
  }
  if (RecordsFlights(flight)) WriteRecords(flight, agents, config.train.env, pool);
  if (options.no_html) return;
  WritePage(options, [&] { return PageData(options, comparison, config, agents, pool); });
}

/// On all ranks together.
void CompareAgents(const CompareOptions& options, Ranks& ranks) {
  const FlightOptions& flight = options.flight;
  ProgramConfig config;
  std::vector<NamedAgent> agents;
  std::string identity;
  DoTogether(ranks, [&] {
    config = ConfigOfAgents(flight, options.agents);
    RequireRoom(options, config.train.env);
    if (ranks.rank() == 0) {
      CheckFiles(options);
      WarnOfTargets(config.train.env);
    }
    if (!options.html.empty()) ReportTemplate();  // without one there is nothing to fly for
    agents = FindAgents(options.agents, config, flight.seed);
    if (ranks.count() > 1) identity = Identity(options, config);
  });
  RequireSameOnRanks(ranks, "what they compare", identity);
  WorkerPool pool(flight.threads);
  const Comparison comparison = Compare(agents, config, flight.episodes, flight.seed, pool, ranks);
  if (ranks.rank() != 0) return;
  const EnvConfig& env = config.train.env;
  const std::string settings = env.term_task == nullptr
                                   ? "preset " + flight.preset
                                   : "settings of the task file of " + env.task;
  fmt::print("{}\n({}; {})\n", ToText(comparison), settings, DescribeWorkers(pool));
  WriteAll(options, comparison, config, agents, pool);
}

}  // namespace

void AddCompareCommand(CLI::App* app) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command =
      app->add_subcommand("compare", "Fly several agents over the same fresh episodes");
  AddAgentList(command, "who flies, separated by commas", &options->agents)->required();
  FlightOptionTexts texts;
  texts.task = TaskHelp() + " (default: the task of a policy)";
  texts.preset = "environment settings to begin with (default: default)";
  texts.json = "write all results here";
  texts.flights =
      "write every agent's first episodes, FILE.csv for agent A to FILE.A.csv, for skein plot";
  AddFlightOptions(command, texts, &options->flight);
  command->add_option("--csv", options->csv, "write a row for every agent here")->type_name("FILE");
  CLI::Option* html =
      command
          ->add_option("--html", options->html,
                       "write the page with the metrics, and the first episodes in 3-D, here "
                       "(default: compare.html, if it can be written)")
          ->type_name("FILE");
  command->add_flag("--no-html", options->no_html, "write no page")->excludes(html);
  command->footer(
      "Initial states, targets and noise are the same for all: they depend on the seed and the "
      "episode alone.\n"
      "Every agent acts at its own rate, policies with their mean action unless @sampled. "
      "Differences are paired,\n"
      "episode by episode, against the first agent.\n"
      "Example: skein compare --task heading --agents policy:runs/a,policy:runs/b,random "
      "--episodes 1000 --csv table.csv\n"
      "         skein compare --task heading --condition windy=60fps,moderate --agents "
      "policy:runs/a,zero");
  command->callback([options] {
    options->flight.flights_on_page = !options->no_html;
    OnLaunchedRanks(options->flight.rank_timeout_s,
                    [&](Ranks& ranks) { CompareAgents(*options, ranks); });
  });
}

}  // namespace skein
