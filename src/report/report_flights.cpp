// SPDX-License-Identifier: Apache-2.0
#include "src/report/report_flights.h"

#include <algorithm>
#include <string>

#include "envs/env_config.h"
#include "envs/task_registry.h"
#include "src/config/conditions.h"
#include "src/evaluation/flight_table.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

/// Of a flight that is longer, a page shows every second, third ... row.
constexpr std::size_t kMostRows = 4000;

Json TargetsJson(const std::vector<TargetQuantity>& quantities) {
  Json targets = Json::array();
  for (const TargetQuantity& target : quantities) {
    targets.push_back({{"column", target.column},
                       {"is_angle", target.is_angle},
                       {"tolerance", target.tolerance}});
  }
  return targets;
}

/// Every `stride`th value.
std::vector<double> Thinned(const std::vector<double>& values, std::size_t stride) {
  std::vector<double> thinned;
  for (std::size_t row = 0; row < values.size(); row += stride) thinned.push_back(values[row]);
  return thinned;
}

/// The flight's columns by their names in files of flights.
Json ColumnsJson(const FlightTable& table, std::size_t stride, DataPack* pack) {
  Json columns = Json::object();
  for (std::size_t k = 1; k < table.names.size(); ++k) {  // 0 is the time
    columns[table.names[k]] = pack->AddQuantised(Thinned(table.columns[k], stride));
  }
  return columns;
}

Json FlightJson(const EnvConfig& env, const RecordedFlight& flight, DataPack* pack) {
  const std::size_t stride = flight.steps.size() / kMostRows + 1;
  double episode_return = 0;
  for (const RecordedStep& step : flight.steps) episode_return += step.reward;
  const FlightTable table = TableOf(env, flight);
  const Termination end = table.terminations.back();
  return {{"end", kTerminationNames[static_cast<std::size_t>(end)]},
          {"return", episode_return},
          {"interval_s", env.control_interval_s * static_cast<double>(stride)},
          {"columns", ColumnsJson(table, stride, pack)}};
}

}  // namespace

Json FlightsJson(const std::vector<AgentFlights>& agents, std::uint64_t seed, DataPack* pack) {
  Json names = Json::array(), flights = Json::array();
  for (const AgentFlights& flown : agents) {
    for (std::size_t episode = 0; episode < flown.flights.size(); ++episode) {
      Json flight = {{"agent", names.size()}, {"episode", episode}};
      flight.update(FlightJson(flown.env, flown.flights[episode], pack));
      flights.push_back(flight);
    }
    names.push_back(flown.agent);
  }
  const AgentFlights& first = agents.front();
  return {{"task", first.env.task},
          {"conditions", DescribeConditions(first.env)},
          {"seed", seed},
          {"agents", names},
          {"targets", TargetsJson(first.targets)},
          {"is_point", MakeTask(first.env)->is_point()},
          {"hold_s", first.env.hold_s},
          {"flights", flights}};
}

}  // namespace skein
