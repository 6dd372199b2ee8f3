// SPDX-License-Identifier: Apache-2.0
#include "src/report/report_data.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <optional>

#include "base/error.h"
#include "src/agents/agent_names.h"
#include "src/agents/policy_file.h"
#include "src/bench/version.h"
#include "src/evaluation/comparison.h"
#include "src/evaluation/evaluation_report.h"
#include "src/evaluation/recording_limit.h"
#include "src/report/report_flights.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 3;
/// The strongest, and the one that keeps its wings upright: what a policy has to beat.
constexpr const char* kAutopilots[] = {"autopilot:aggressive", "autopilot:traditional"};

Json TableJson(const CsvColumns& table, DataPack* pack) {
  Json columns = Json::object();
  for (std::size_t k = 0; k < table.names.size(); ++k) {
    columns[table.names[k]] = pack->AddNumbers(table.values[k]);
  }
  return columns;
}

/// `note` is one that the run's own do not hold; empty: there is none.
Json RunJson(const RunRecord& run, const std::string& note, std::size_t repetition,
             DataPack* pack) {
  std::vector<std::string> notes = run.notes;
  if (!note.empty()) notes.push_back(note);
  return {{"name", run.name},
          {"path", run.path},
          {"task", run.config.train.env.task},
          {"seed", run.config.train.seed},
          {"preset", run.preset},
          {"total_steps", run.config.train.total_steps},
          {"repetition", repetition},
          {"notes", notes},
          {"configuration", ConfigurationJson(run)},
          {"metrics", TableJson(run.metrics, pack)},
          {"timing", TableJson(run.timing, pack)},
          {"evaluation", run.evaluation}};
}

/// The number of the runs' repetition, those of one another having the same.
std::vector<std::size_t> Repetitions(const std::vector<RunRecord>& runs) {
  std::map<std::string, std::size_t> known;
  std::vector<std::size_t> numbers;
  for (const RunRecord& run : runs) {
    numbers.push_back(known.emplace(Repetition(run), known.size()).first->second);
  }
  return numbers;
}

/// Runs whose policies fly the same episodes.
struct FlownGroup {
  ProgramConfig config;
  std::uint64_t seed = 0;
  std::vector<NamedAgent> agents;
};

std::uint64_t EvaluationSeed(const RunRecord& run) {
  const auto seed = run.evaluation.is_object() ? run.evaluation.find("seed") : run.evaluation.end();
  if (seed != run.evaluation.end() && seed->is_number_unsigned()) return seed->get<std::uint64_t>();
  return run.config.train.seed;
}

/// The run's policy; none, and why, if there is none that flies.
std::optional<Agent> PolicyOf(const RunRecord& run, std::string* note) {
  try {
    return FindAgent("policy:" + run.path, run.config, run.config.train.seed);
  } catch (const Error& error) {
    *note = fmt::format("no flights: {}", error.what());
    return std::nullopt;
  }
}

/// Of a task that they do not fly, none.
void AddAutopilots(FlownGroup* group) {
  for (const char* name : kAutopilots) {
    try {
      group->agents.push_back({name, FindAgent(name, group->config, group->seed)});
    } catch (const Error&) {
      return;
    }
  }
}

/// `notes` has a place for each run.
std::vector<FlownGroup> GroupByEnvironment(const std::vector<RunRecord>& runs,
                                           std::vector<std::string>* notes) {
  std::map<std::string, std::size_t> known;
  std::vector<FlownGroup> groups;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const RunRecord& run = runs[i];
    const std::optional<Agent> policy = PolicyOf(run, &(*notes)[i]);
    if (!policy) continue;
    const std::string environment = EnvironmentJson(run.config).dump();
    const auto [place, is_new] = known.emplace(environment, groups.size());
    if (is_new) groups.push_back({run.config, EvaluationSeed(run), {}});
    groups[place->second].agents.push_back({run.name, *policy});
  }
  for (FlownGroup& group : groups) AddAutopilots(&group);
  return groups;
}

/// Empty of what only describes a flight.
const char* NameOf(BetterSide side) {
  switch (side) {
    case BetterSide::kHigher:
      return "higher";
    case BetterSide::kLower:
      return "lower";
    case BetterSide::kNeither:
      break;
  }
  return "";
}

Json QuantitiesJson(const std::vector<Quantity>& quantities) {
  Json rows = Json::array();
  for (const Quantity& quantity : quantities) {
    rows.push_back({{"key", quantity.key},
                    {"symbol", quantity.symbol},
                    {"label", quantity.label},
                    {"section", TitleOf(quantity.section)},
                    {"shown_per_unit", quantity.shown_per_unit},
                    {"decimals", quantity.decimals},
                    {"is_headline", quantity.is_headline},
                    {"better", NameOf(quantity.better)}});
  }
  return rows;
}

Json ComparisonJson(const Comparison& comparison, const ProgramConfig& config) {
  return ShownComparison(ToJson(comparison, config), config);
}

/// How many are shown of a group.
int FlightsOf(const ReportRequest& request, const FlownGroup& group) {
  const EnvConfig& env = group.config.train.env;
  const double longest_s = LongestFlight(env);
  if (request.flights_option.empty()) {
    return std::min(request.flights, MostFlights(group.agents.size(), longest_s, env));
  }
  RequireRoomFor(request.flights, group.agents.size(), longest_s, env, request.flights_option);
  return request.flights;
}

std::vector<AgentFlights> Fly(const FlownGroup& group, int count, WorkerPool& pool) {
  EvaluationOptions options;
  options.episodes = count;
  options.seed = group.seed;
  std::vector<AgentFlights> flown;
  for (const NamedAgent& named : group.agents) {
    flown.push_back(FlyAndRecord(named.name, named.agent,
                                 named.agent.EnvironmentFor(group.config.train.env), options, count,
                                 pool));
  }
  return flown;
}

std::string Now() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

/// The parts of a report's document that are lists.
struct Parts {
  Json runs = Json::array(), comparisons = Json::array(), flights = Json::array();
};

std::string Deflated(const DataPack& pack, const Parts& parts, const std::string& made) {
  const BuildInfo& build = Build();
  return pack.Deflated({{"format", kFormat},
                        {"skein", fmt::format("{} (commit {})", build.version, build.commit)},
                        {"made", made.empty() ? Now() : made},
                        {"runs", parts.runs},
                        {"comparisons", parts.comparisons},
                        {"flights", parts.flights}});
}

}  // namespace

Json ShownComparison(Json comparison, const ProgramConfig& config) {
  comparison["quantities"] = QuantitiesJson(QuantitiesOf(config.train.env));
  return comparison;
}

std::string ReportData(const ReportRequest& request, WorkerPool& pool) {
  const std::vector<RunRecord> runs = ReadRuns(request);
  return ReportData(runs, FlyRuns(runs, request, pool), request);
}

std::vector<RunRecord> ReadRuns(const ReportRequest& request) {
  std::vector<RunRecord> runs;
  for (const std::string& path : request.runs) runs.push_back(ReadRunRecord(path));
  std::map<std::string, int> count;
  for (const RunRecord& run : runs) ++count[run.name];
  for (RunRecord& run : runs) {
    if (count[run.name] > 1) run.name = run.path;
  }
  return runs;
}

ReportFlights FlyRuns(const std::vector<RunRecord>& runs, const ReportRequest& request,
                      WorkerPool& pool) {
  ReportFlights flown = {Json::array(), Json::array(), {}, {}};
  flown.notes.resize(runs.size());
  if (request.episodes == 0 && request.flights == 0) return flown;
  const std::vector<FlownGroup> groups = GroupByEnvironment(runs, &flown.notes);
  std::vector<int> flights;
  for (const FlownGroup& group : groups) flights.push_back(FlightsOf(request, group));
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const FlownGroup& group = groups[i];
    if (request.episodes > 0) {
      flown.comparisons.push_back(ComparisonJson(
          Compare(group.agents, group.config, request.episodes, group.seed, pool), group.config));
    }
    if (flights[i] > 0) {
      flown.flights.push_back(FlightsJson(Fly(group, flights[i], pool), group.seed,
                                          kMostRowsOfPage / groups.size(), &flown.pack));
    }
  }
  return flown;
}

std::string ReportData(const std::vector<RunRecord>& runs, const ReportFlights& flown,
                       const ReportRequest& request) {
  DataPack pack = flown.pack;
  Parts parts;
  parts.flights = flown.flights;
  for (const Json& comparison : request.comparisons) parts.comparisons.push_back(comparison);
  for (const Json& comparison : flown.comparisons) parts.comparisons.push_back(comparison);
  const std::vector<std::size_t> repetitions = Repetitions(runs);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    parts.runs.push_back(RunJson(runs[i], flown.notes[i], repetitions[i], &pack));
  }
  return Deflated(pack, parts, request.made);
}

std::string FlightsData(const std::vector<AgentFlights>& agents, std::uint64_t seed) {
  DataPack pack;
  Parts parts;
  parts.flights.push_back(FlightsJson(agents, seed, kMostRowsOfPage, &pack));
  return Deflated(pack, parts, "");
}

std::string ComparisonData(const Comparison& comparison, const ProgramConfig& config,
                           const std::vector<AgentFlights>& agents) {
  DataPack pack;
  Parts parts;
  parts.comparisons.push_back(ComparisonJson(comparison, config));
  parts.flights.push_back(FlightsJson(agents, comparison.seed, kMostRowsOfPage, &pack));
  return Deflated(pack, parts, "");
}

}  // namespace skein
