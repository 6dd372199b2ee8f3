// SPDX-License-Identifier: Apache-2.0
#include "src/evaluation/flight_summary.h"

#include <fmt/format.h>

#include <cmath>

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

Json NumberOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

int DecimalsOf(int metric) {
  switch (metric) {
    case kMeanTrueAirspeed:
    case kMeanClimbRate:
    case kMeanAbsClimbRate:
      return 1;
    case kMeanLoadFactor:
    case kMeanAbsAlpha:
      return 2;
    default:
      return 3;
  }
}

std::vector<Quantity> MakeQuantities() {
  const auto succeeded = [](const Episode& episode) {
    return episode.termination == Termination::kTargetReached;
  };
  std::vector<Quantity> quantities = {
      {"success_rate", "", "success, %", 100, 1,
       [succeeded](const Episode& episode, double) { return succeeded(episode) ? 1.0 : 0.0; }},
      {"return", "", "return", 1, 1,
       [](const Episode& episode, double) { return episode.episode_return; }},
      {"time_to_target_s", "T", "time to target, s", 1, 2,
       [succeeded](const Episode& episode, double control_interval_s) {
         return succeeded(episode) ? episode.steps * control_interval_s : std::nan("");
       }}};
  for (int k = 0; k < kNumFlightMetrics; ++k) {
    const auto index = static_cast<std::size_t>(k);
    const FlightMetricName& name = kFlightMetricNames[index];
    quantities.push_back(
        {name.key, name.symbol, name.meaning, 1, DecimalsOf(k),
         [index](const Episode& episode, double) { return episode.metrics[index]; }});
  }
  return quantities;
}

}  // namespace

const std::vector<Quantity>& Quantities() {
  static const std::vector<Quantity> quantities = MakeQuantities();
  return quantities;
}

FlightSummary SummariseFlights(const std::vector<Episode>& episodes, double control_interval_s) {
  FlightSummary summary;
  summary.result = Summarise(episodes, control_interval_s);
  for (const Quantity& quantity : Quantities()) {
    std::vector<double> values;
    values.reserve(episodes.size());
    for (const Episode& episode : episodes) {
      values.push_back(quantity.value(episode, control_interval_s));
    }
    summary.estimates.push_back(EstimateMean(values));
  }
  summary.estimates[kSuccessQuantity] = EstimateShare(
      summary.result.terminations[static_cast<std::size_t>(Termination::kTargetReached)],
      summary.result.episodes);
  return summary;
}

Json ToJson(const Estimate& estimate) {
  return {{"value", NumberOrNull(estimate.value)},
          {"low", NumberOrNull(estimate.low)},
          {"high", NumberOrNull(estimate.high)},
          {"count", estimate.count}};
}

Json ToJson(const FlightSummary& summary) {
  const EvaluationResult& result = summary.result;
  Json terminations = Json::object(), estimates = Json::object();
  for (std::size_t kind = 1; kind < kNumTerminations; ++kind) {
    terminations[kTerminationNames[kind]] = result.terminations[kind];
  }
  for (std::size_t k = 0; k < Quantities().size(); ++k) {
    estimates[Quantities()[k].key] = ToJson(summary.estimates[k]);
  }
  return {{"episodes", result.episodes},
          {"success_rate", result.success_rate},
          {"return_mean", result.return_mean},
          {"time_to_target_mean", NumberOrNull(result.time_to_target_mean_s)},
          {"terminations", terminations},
          {"estimates", estimates}};
}

std::string FormatEstimate(const Quantity& quantity, const Estimate& estimate) {
  if (std::isnan(estimate.value)) return "-";
  const auto shown = [&](double value) {
    std::string text = fmt::format("{:.{}f}", value * quantity.shown_per_unit, quantity.decimals);
    const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
    return is_zero && text[0] == '-' ? text.substr(1) : text;
  };
  if (std::isnan(estimate.low)) return shown(estimate.value);
  const std::string above = shown(estimate.high - estimate.value);
  if (shown(estimate.value - estimate.low) == above) {
    return fmt::format("{} +- {}", shown(estimate.value), above);
  }
  return fmt::format("{} ({}, {})", shown(estimate.value), shown(estimate.low),
                     shown(estimate.high));
}

std::string CsvCells(const Estimate& estimate) {
  std::string cells;
  for (const double value : {estimate.value, estimate.low, estimate.high}) {
    cells += std::isfinite(value) ? fmt::format(",{}", value) : ",";
  }
  return cells;
}

std::string CsvText(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string FormatTerminations(const EvaluationResult& result) {
  std::string text;
  for (std::size_t kind = 1; kind < kNumTerminations; ++kind) {
    if (result.terminations[kind] == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", kTerminationNames[kind],
                        result.terminations[kind]);
  }
  return text;
}

std::string FormatFlightMetrics(const FlightSummary& summary) {
  std::vector<std::string> cells;
  for (std::size_t k = 0; k < Quantities().size(); ++k) {
    const Quantity& quantity = Quantities()[k];
    if (quantity.symbol.empty()) continue;
    cells.push_back(fmt::format("{:6}{:18}{:>18}", quantity.symbol, quantity.label,
                                FormatEstimate(quantity, summary.estimates[k])));
  }
  std::string text;
  const std::size_t rows = (cells.size() + 1) / 2;
  for (std::size_t row = 0; row < rows; ++row) {
    text += (row > 0 ? "\n  " : "  ") + cells[row];
    if (row + rows < cells.size()) text += "    " + cells[row + rows];
  }
  return text;
}

}  // namespace skein
