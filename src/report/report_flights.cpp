// SPDX-License-Identifier: Apache-2.0
#include "src/report/report_flights.h"

#include <algorithm>
#include <array>
#include <string>

#include "envs/aircraft/registry.h"
#include "envs/env_config.h"
#include "envs/task_registry.h"
#include "src/config/conditions.h"
#include "src/evaluation/flight_table.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

/// Of a flight that is longer, a page shows every second, third ... row.
constexpr std::size_t kMostRows = 4000;
/// Of what no page shows: speeds along the body's axes are in airspeed, alpha and beta.
constexpr std::array<const char*, 3> kLeftOut = {"u_fps", "v_fps", "w_fps"};
/// A chase sees steps of a foot.
constexpr std::array<const char*, 3> kPlaces = {"north_ft", "east_ft", "altitude_ft"};
constexpr int kLevelsOfMany = 4000;

template <std::size_t N>
bool Holds(const std::array<const char*, N>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

Json TargetsJson(const std::vector<TargetQuantity>& quantities) {
  Json targets = Json::array();
  for (const TargetQuantity& target : quantities) {
    targets.push_back({{"column", target.column},
                       {"is_angle", target.is_angle},
                       {"tolerance", target.tolerance}});
  }
  return targets;
}

/// Every `stride`th value, and the last one, at which the flight ended.
std::vector<double> Thinned(const std::vector<double>& values, std::size_t stride) {
  std::vector<double> thinned;
  for (std::size_t row = 0; row + 1 < values.size(); row += stride) thinned.push_back(values[row]);
  thinned.push_back(values.back());
  return thinned;
}

/// How finely flights are shown: each row of `stride` and the last, and their columns to so many
/// levels.
struct Fineness {
  std::size_t stride = 1;
  int levels = DataPack::kMostLevels;
};

Fineness FinenessOf(const std::vector<AgentFlights>& agents, std::size_t most_rows) {
  std::size_t rows = 0;
  for (const AgentFlights& flown : agents) {
    for (const RecordedFlight& flight : flown.flights) rows += flight.steps.size() + 1;
  }
  if (rows <= most_rows) return {};
  return {(rows + most_rows - 1) / most_rows, kLevelsOfMany};
}

/// The flight's columns by their names in files of flights.
Json ColumnsJson(const FlightTable& table, const Fineness& fineness, DataPack* pack) {
  Json columns = Json::object();
  for (std::size_t k = 1; k < table.names.size(); ++k) {  // 0 is the time
    const std::string& name = table.names[k];
    if (Holds(kLeftOut, name)) continue;
    columns[name] =
        pack->AddQuantised(Thinned(table.columns[k], fineness.stride),
                           Holds(kPlaces, name) ? DataPack::kMostLevels : fineness.levels);
  }
  return columns;
}

/// When a mission's next target came: at the end of the step before it was flown to.
Json NewTargetsJson(const RecordedFlight& flight, double interval_s) {
  Json times = Json::array();
  for (std::size_t k = 1; k < flight.steps.size(); ++k) {
    if (flight.steps[k].target != flight.steps[k - 1].target) {
      times.push_back(static_cast<double>(k) * interval_s);
    }
  }
  return times;
}

Json ReachedJson(const RecordedFlight& flight, double interval_s) {
  Json times = Json::array();
  for (std::size_t k = 0; k < flight.steps.size(); ++k) {
    if (flight.steps[k].reaches_target) times.push_back(static_cast<double>(k + 1) * interval_s);
  }
  return times;
}

Json FlightJson(const EnvConfig& env, const RecordedFlight& flight, Fineness fineness,
                DataPack* pack) {
  fineness.stride = std::max(fineness.stride, flight.steps.size() / kMostRows + 1);
  double episode_return = 0;
  for (const RecordedStep& step : flight.steps) episode_return += step.reward;
  const FlightTable table = TableOf(env, flight);
  const Termination end = table.terminations.back();
  const double interval_s = env.control_interval_s;
  return {{"end", kTerminationNames[static_cast<std::size_t>(end)]},
          {"return", episode_return},
          {"duration_s", static_cast<double>(flight.steps.size()) * interval_s},
          {"new_target_s", NewTargetsJson(flight, interval_s)},
          {"reached_s", ReachedJson(flight, interval_s)},
          {"interval_s", interval_s * static_cast<double>(fineness.stride)},
          {"columns", ColumnsJson(table, fineness, pack)}};
}

}  // namespace

Json FlightsJson(const std::vector<AgentFlights>& agents, std::uint64_t seed, std::size_t most_rows,
                 DataPack* pack) {
  const Fineness fineness = FinenessOf(agents, most_rows);
  Json names = Json::array(), flights = Json::array();
  for (const AgentFlights& flown : agents) {
    for (std::size_t episode = 0; episode < flown.flights.size(); ++episode) {
      Json flight = {{"agent", names.size()}, {"episode", episode}};
      flight.update(FlightJson(flown.env, flown.flights[episode], fineness, pack));
      flights.push_back(flight);
    }
    names.push_back(flown.agent);
  }
  const AgentFlights& first = agents.front();
  return {{"task", first.env.task},
          {"conditions", DescribeEvaluation(first.env)},
          {"seed", seed},
          {"agents", names},
          {"targets", TargetsJson(first.targets)},
          {"is_point", MakeTask(first.env)->is_point()},
          {"hold_s", first.env.hold_s},
          {"span_ft", LoadAircraft(first.env.aircraft).airframe.span_ft},
          {"flights", flights}};
}

}  // namespace skein
