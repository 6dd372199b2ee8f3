// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "src/evaluation/estimate.h"
#include "train/policy/evaluate.h"

namespace skein {

/// Something that every episode has a value of.
struct Quantity {
  std::string key;        ///< in files, with its unit
  std::string symbol;     ///< in the paper's Table 6, or empty
  std::string label;      ///< for people, with its unit
  double shown_per_unit;  ///< what people see of it: 100 for percent
  int decimals;           ///< and how exactly
  /// Of an episode flown with EvaluationOptions::flight_metrics; NaN if it has none.
  std::function<double(const Episode& episode, double control_interval_s)> value;
};

/// Success (1 or 0), return, time to the target (of episodes that reached it), then the flight
/// metrics in their order.
const std::vector<Quantity>& Quantities();
inline constexpr int kSuccessQuantity = 0, kReturnQuantity = 1, kTimeQuantity = 2;

/// How an agent flew its episodes.
struct FlightSummary {
  EvaluationResult result;
  std::vector<Estimate> estimates;  ///< by Quantities()
};

/// Of episodes flown with EvaluationOptions::flight_metrics.
FlightSummary SummariseFlights(const std::vector<Episode>& episodes, double control_interval_s);

/// Keys: episodes, success_rate, return_mean, time_to_target_mean (s; null if no episode
/// succeeded), terminations (count by kind), estimates (by key of the quantity: value, low, high,
/// count).
nlohmann::ordered_json ToJson(const FlightSummary& summary);
/// value, low and high (null where there is none), and count.
nlohmann::ordered_json ToJson(const Estimate& estimate);

/// "15.83 +- 0.31"; where the interval lies to one side, "100.0 (99.6, 100.0)"; "-" for nothing.
std::string FormatEstimate(const Quantity& quantity, const Estimate& estimate);
/// The three numbers as cells of CSV, each with a comma ahead; empty where there is none.
std::string CsvCells(const Estimate& estimate);
/// A cell of CSV, in quotes where it must be.
std::string CsvText(const std::string& text);
/// "target_reached 998, time_limit 2".
std::string FormatTerminations(const EvaluationResult& result);

/// The figures of the paper's Table 6 in two columns, for people; without a newline at the end.
std::string FormatFlightMetrics(const FlightSummary& summary);

}  // namespace skein
