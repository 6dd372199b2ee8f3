// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "src/evaluation/estimate.h"
#include "src/evaluation/quantities.h"
#include "train/policy/evaluate.h"

namespace skein {

/// How an agent flew its episodes.
struct FlightSummary {
  EvaluationResult result;
  bool is_mission = false;
  std::vector<Quantity> quantities;  ///< QuantitiesOf the environment
  std::vector<Estimate> estimates;   ///< by them
};

/// Of episodes of `env` flown with EvaluationOptions::flight_metrics.
FlightSummary SummariseFlights(const std::vector<Episode>& episodes, const EnvConfig& env);

/// Keys: episodes, success_rate, return_mean, time_to_target_mean (s; null if no episode
/// succeeded), terminations (count by kind), estimates (by key of the quantity: value, low, high,
/// count).
nlohmann::ordered_json ToJson(const FlightSummary& summary);
/// value, low and high (null where there is none), and count.
nlohmann::ordered_json ToJson(const Estimate& estimate);

/// "15.83 +- 0.31"; where the interval lies to one side, "100.0 (99.6, 100.0)"; "-" for nothing.
std::string FormatEstimate(const Quantity& quantity, const Estimate& estimate);
/// The same of the summary's `k`-th quantity, of a peak with the worst flight's behind it: "4.12 +-
/// 0.05 (6.80)".
std::string FormatFigure(const FlightSummary& summary, std::size_t k);
/// It has a place of its own in tables for people, and is not behind another as FormatFigure puts
/// it.
bool HasOwnPlace(const Quantity& quantity);
/// The three numbers as cells of CSV, each with a comma ahead; empty where there is none.
std::string CsvCells(const Estimate& estimate);
/// Whether a flight that ended by `end`, of kTerminationNames, is a mission that was flown to its
/// end: its time limit is none to name.
bool IsMissionFlown(bool is_mission, std::string_view end);
/// "ended by target_reached"; of a mission "lost by overload". Empty if IsMissionFlown:
/// kSuccessQuantity has them.
std::string EndLabel(bool is_mission, std::size_t termination);
/// "ended by target_reached 998, time_limit 2"; of missions "lost by overload 2", or empty.
std::string FormatEnds(const FlightSummary& summary);

/// What a table calls a section; empty for those that come first.
const char* TitleOf(QuantitySection section);

/// The figures of the paper's Table 6, of holding and of peaks in two columns, of actions in one
/// for each command, for people; without a newline at the end.
std::string FormatFlightMetrics(const FlightSummary& summary);

}  // namespace skein
