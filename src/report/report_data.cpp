// SPDX-License-Identifier: Apache-2.0
#include "src/report/report_data.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <map>
#include <optional>

#include "base/error.h"
#include "src/agents/agent_names.h"
#include "src/agents/policy_file.h"
#include "src/bench/version.h"
#include "src/evaluation/comparison.h"
#include "src/evaluation/evaluation_report.h"
#include "src/report/report_flights.h"
#include "src/report/run_record.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;
/// The strongest in turns and the gentlest: what a policy has to beat, and how it should feel.
constexpr const char* kAutopilots[] = {"autopilot:aggressive", "autopilot:parallel"};

/// Gives runs of the same name their paths.
void SetNamesApart(std::vector<RunRecord>* runs) {
  std::map<std::string, int> count;
  for (const RunRecord& run : *runs) ++count[run.name];
  for (RunRecord& run : *runs) {
    if (count[run.name] > 1) run.name = run.path;
  }
}

Json TableJson(const CsvColumns& table, DataPack* pack) {
  Json columns = Json::object();
  for (std::size_t k = 0; k < table.names.size(); ++k) {
    columns[table.names[k]] = pack->AddFloats(table.values[k]);
  }
  return columns;
}

Json RunJson(const RunRecord& run, std::size_t repetition, DataPack* pack) {
  return {{"name", run.name},
          {"path", run.path},
          {"task", run.config.train.env.task},
          {"seed", run.config.train.seed},
          {"preset", run.preset},
          {"total_steps", run.config.train.total_steps},
          {"repetition", repetition},
          {"notes", run.notes},
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

/// The run's policy; none, with a note, if there is none that flies.
std::optional<Agent> PolicyOf(RunRecord* run) {
  try {
    return FindAgent("policy:" + run->path, run->config, run->config.train.seed);
  } catch (const Error& error) {
    run->notes.push_back(fmt::format("no flights: {}", error.what()));
    return std::nullopt;
  }
}

std::vector<FlownGroup> GroupByEnvironment(std::vector<RunRecord>* runs) {
  std::map<std::string, std::size_t> known;
  std::vector<FlownGroup> groups;
  for (RunRecord& run : *runs) {
    const std::optional<Agent> policy = PolicyOf(&run);
    if (!policy) continue;
    const std::string environment = EnvironmentJson(run.config).dump();
    const auto [place, is_new] = known.emplace(environment, groups.size());
    if (is_new) groups.push_back({run.config, EvaluationSeed(run), {}});
    groups[place->second].agents.push_back({run.name, *policy});
  }
  for (FlownGroup& group : groups) {
    for (const char* name : kAutopilots) {
      group.agents.push_back({name, FindAgent(name, group.config, group.seed)});
    }
  }
  return groups;
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
                    {"is_headline", quantity.is_headline}});
  }
  return rows;
}

Json ComparisonJson(const FlownGroup& group, int episodes, WorkerPool& pool) {
  const Comparison comparison = Compare(group.agents, group.config, episodes, group.seed, pool);
  Json json = ToJson(comparison, group.config);
  json["quantities"] = QuantitiesJson(comparison.quantities);
  return json;
}

std::string Now() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

}  // namespace

std::string ReportData(const ReportRequest& request, WorkerPool& pool) {
  std::vector<RunRecord> runs;
  for (const std::string& path : request.runs) runs.push_back(ReadRunRecord(path));
  SetNamesApart(&runs);
  DataPack pack;
  Json comparisons = Json::array(), flights = Json::array(), shown = Json::array();
  const bool flies = request.episodes > 0 || request.flights > 0;
  for (const FlownGroup& group : flies ? GroupByEnvironment(&runs) : std::vector<FlownGroup>()) {
    if (request.episodes > 0) {
      comparisons.push_back(ComparisonJson(group, request.episodes, pool));
    }
    if (request.flights > 0) {
      flights.push_back(FlightsJson(group.agents, group.config.train.env, request.flights,
                                    group.seed, pool, &pack));
    }
  }
  const std::vector<std::size_t> repetitions = Repetitions(runs);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    shown.push_back(RunJson(runs[i], repetitions[i], &pack));
  }
  const BuildInfo& build = Build();
  return pack.Deflated({{"format", kFormat},
                        {"skein", fmt::format("{} (commit {})", build.version, build.commit)},
                        {"made", request.made.empty() ? Now() : request.made},
                        {"runs", shown},
                        {"comparisons", comparisons},
                        {"flights", flights}});
}

}  // namespace skein
