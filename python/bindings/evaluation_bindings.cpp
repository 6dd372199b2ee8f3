// SPDX-License-Identifier: Apache-2.0
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/worker_pool.h"
#include "envs/flight_metrics.h"
#include "python/bindings/bindings.h"
#include "python/bindings/flying_agent.h"
#include "python/bindings/interruption.h"
#include "src/bench/machine.h"
#include "src/config/program_config.h"
#include "src/evaluation/comparison.h"
#include "src/evaluation/flight_file.h"
#include "src/evaluation/flight_summary.h"
#include "src/evaluation/recording_limit.h"
#include "train/policy/evaluate.h"
#include "train/policy/record_flights.h"

namespace nb = nanobind;

namespace skein {
namespace {

template <typename T, typename Read>
nb::object Column(const std::vector<Episode>& episodes, const Read& read) {
  std::vector<T> column;
  column.reserve(episodes.size());
  for (const Episode& episode : episodes) column.push_back(static_cast<T>(read(episode)));
  return nb::cast(ToNumpy(std::move(column), {episodes.size()}));
}

nb::dict EpisodeColumns(const std::vector<Episode>& episodes) {
  nb::dict columns;
  columns["termination"] =
      Column<std::uint8_t>(episodes, [](const Episode& e) { return e.termination; });
  columns["succeeded"] =
      Column<std::uint8_t>(episodes, [](const Episode& e) { return e.succeeded; });
  columns["episode_return"] =
      Column<float>(episodes, [](const Episode& e) { return e.episode_return; });
  columns["control_steps"] =
      Column<std::int32_t>(episodes, [](const Episode& e) { return e.steps; });
  columns["reached_step"] =
      Column<std::int32_t>(episodes, [](const Episode& e) { return e.reached_step; });
  columns["entered_step"] =
      Column<std::int32_t>(episodes, [](const Episode& e) { return e.entered_step; });
  for (std::size_t k = 0; k < kFlightMetricNames.size(); ++k) {
    columns[kFlightMetricNames[k].key] =
        Column<float>(episodes, [k](const Episode& e) { return e.metrics[k]; });
  }
  return columns;
}

EvaluationOptions Options(int episodes, std::uint64_t seed) {
  EvaluationOptions options;
  options.episodes = episodes;
  options.seed = seed;
  options.flight_metrics = true;
  return options;
}

/// The summary as JSON, the episodes' columns, and the hash of what they began with.
nb::tuple EvaluateAgent(const FlyingAgent& flying, const ProgramConfig& config, int episodes,
                        std::uint64_t seed, int threads) {
  WorkerPool pool(threads);
  const EnvConfig env = flying.agent.EnvironmentFor(config.train.env);
  const FlownEpisodes flown = UnlockedAsWhole(
      pool, [&] { return FlyEpisodes(flying.agent, env, Options(episodes, seed), pool); });
  return nb::make_tuple(ToJson(SummariseFlights(flown.episodes, env)).dump(),
                        EpisodeColumns(flown.episodes), flown.starts);
}

/// The comparison as JSON, and as a table for people.
nb::tuple CompareAgents(const std::vector<FlyingAgent>& agents,
                        const std::vector<std::string>& names, const ProgramConfig& config,
                        int episodes, std::uint64_t seed, int threads) {
  WorkerPool pool(threads);
  std::vector<NamedAgent> named;
  for (std::size_t i = 0; i < agents.size(); ++i) named.push_back({names[i], agents[i].agent});
  const Comparison comparison =
      UnlockedAsWhole(pool, [&] { return Compare(named, config, episodes, seed, pool); });
  nlohmann::ordered_json summary = ToJson(comparison, config);
  summary["program"] = ProgramJson();
  return nb::make_tuple(summary.dump(), ToText(comparison));
}

/// The first `count` of those episodes as a CSV table, a row for every control step.
std::string RecordAgent(const FlyingAgent& flying, const ProgramConfig& config, int count,
                        std::uint64_t seed, int threads, bool with_observations) {
  WorkerPool pool(threads);
  const EnvConfig env = flying.agent.EnvironmentFor(config.train.env);
  RequireRoomFor(count, 1, LongestFlight(env), env, "count");
  const FlightColumns columns =
      with_observations ? FlightColumns::kStatesAndObservations : FlightColumns::kStates;
  return UnlockedAsWhole(pool, [&] {
    return FlightsCsv(env, RecordFlights(flying.agent, env, Options(count, seed), count, pool),
                      columns, &pool);
  });
}

}  // namespace

void BindEvaluation(nb::module_& module) {
  module.def("evaluate", &EvaluateAgent, nb::arg("agent"), nb::arg("config"), nb::arg("episodes"),
             nb::arg("seed"), nb::arg("threads"));
  module.def("compare", &CompareAgents, nb::arg("agents"), nb::arg("names"), nb::arg("config"),
             nb::arg("episodes"), nb::arg("seed"), nb::arg("threads"));
  module.def("record", &RecordAgent, nb::arg("agent"), nb::arg("config"), nb::arg("count"),
             nb::arg("seed"), nb::arg("threads"), nb::arg("with_observations"));
}

}  // namespace skein
