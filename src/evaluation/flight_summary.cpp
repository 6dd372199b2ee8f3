// SPDX-License-Identifier: Apache-2.0
#include "src/evaluation/flight_summary.h"

#include <fmt/format.h>

#include <cmath>

#include "envs/actions.h"
#include "src/files/json_number.h"
#include "src/files/text_table.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

/// Where the section's quantities are, but for those that stand behind others.
std::vector<std::size_t> IndicesOf(const FlightSummary& summary, QuantitySection section) {
  std::vector<std::size_t> indices;
  for (std::size_t k = 0; k < summary.quantities.size(); ++k) {
    const Quantity& quantity = summary.quantities[k];
    if (quantity.section == section && HasOwnPlace(quantity)) indices.push_back(k);
  }
  return indices;
}

std::string TitleLine(QuantitySection section) {
  const std::string title = TitleOf(section);
  return title.empty() ? "" : title + ":\n";
}

/// Lines, each with a newline; none of a section without quantities.
std::string InTwoColumns(const FlightSummary& summary, QuantitySection section) {
  const std::vector<std::size_t> indices = IndicesOf(summary, section);
  if (indices.empty()) return "";
  constexpr std::size_t kWidth = 46;  // of each column, and longer than any label
  std::vector<std::string> cells;
  for (const std::size_t k : indices) {
    const Quantity& quantity = summary.quantities[k];
    const std::string label = quantity.symbol.empty()
                                  ? quantity.label
                                  : fmt::format("{:6}{}", quantity.symbol, quantity.label);
    cells.push_back(
        fmt::format("{} {:>{}}", label, FormatFigure(summary, k), kWidth - 1 - label.size()));
  }
  std::string text = TitleLine(section);
  const std::size_t rows = (cells.size() + 1) / 2;
  for (std::size_t row = 0; row < rows; ++row) {
    text += "  " + cells[row];
    if (row + rows < cells.size()) text += "   " + cells[row + rows];
    text += "\n";
  }
  return text;
}

/// Lines, each with a newline: a column for every command; none of a section without quantities.
std::string InCommandColumns(const FlightSummary& summary, QuantitySection section) {
  const std::vector<std::size_t> indices = IndicesOf(summary, section);
  if (indices.empty()) return "";
  constexpr std::size_t kLabelWidth = 24, kCellWidth = 19;
  std::string text;
  TextTable table(kLabelWidth, kCellWidth, &text);
  table.Begin(TitleOf(section));
  for (std::size_t k = 0; k < kActionSize; ++k) table.Cell(summary.quantities[indices[k]].symbol);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const Quantity& quantity = summary.quantities[indices[i]];
    if (i % kActionSize == 0) {
      table.End();
      table.Begin("  " + quantity.label);
    }
    table.Cell(FormatEstimate(quantity, summary.estimates[indices[i]]));
  }
  table.End();
  return text;
}

}  // namespace

FlightSummary SummariseFlights(const std::vector<Episode>& episodes, const EnvConfig& env) {
  FlightSummary summary;
  summary.result = Summarise(episodes, env.control_interval_s);
  summary.is_mission = EvaluationConfig(env).mission.enabled();
  summary.quantities = QuantitiesOf(env);
  for (const Quantity& quantity : summary.quantities) {
    summary.estimates.push_back(EstimateOf(quantity, episodes, env.control_interval_s));
  }
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
  for (std::size_t k = 0; k < summary.quantities.size(); ++k) {
    estimates[summary.quantities[k].key] = ToJson(summary.estimates[k]);
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

bool HasOwnPlace(const Quantity& quantity) {
  return quantity.section != QuantitySection::kPeaks || quantity.statistic == Statistic::kMean;
}

std::string FormatFigure(const FlightSummary& summary, std::size_t k) {
  std::string figure = FormatEstimate(summary.quantities[k], summary.estimates[k]);
  const bool is_peak = summary.quantities[k].section == QuantitySection::kPeaks;
  if (!is_peak || summary.estimates[k].count == 0) return figure;
  return fmt::format("{} ({})", figure,
                     FormatEstimate(summary.quantities[k + 1], summary.estimates[k + 1]));
}

std::string CsvCells(const Estimate& estimate) {
  std::string cells;
  for (const double value : {estimate.value, estimate.low, estimate.high}) {
    cells += std::isfinite(value) ? fmt::format(",{}", value) : ",";
  }
  return cells;
}

bool IsMissionFlown(bool is_mission, std::string_view end) {
  return is_mission && end == kTerminationNames[static_cast<std::size_t>(Termination::kTimeLimit)];
}

std::string EndLabel(bool is_mission, std::size_t termination) {
  if (IsMissionFlown(is_mission, kTerminationNames[termination])) return "";
  return fmt::format("{} by {}", is_mission ? "lost" : "ended", kTerminationNames[termination]);
}

std::string FormatEnds(const FlightSummary& summary) {
  std::string text;
  for (std::size_t kind = 1; kind < kNumTerminations; ++kind) {
    const std::string label = EndLabel(summary.is_mission, kind);
    const int count = summary.result.terminations[kind];
    if (count == 0 || label.empty()) continue;
    text += fmt::format("{} {}",
                        text.empty() ? label : fmt::format(", {}", kTerminationNames[kind]), count);
  }
  return text;
}

const char* TitleOf(QuantitySection section) {
  switch (section) {
    case QuantitySection::kActions:
      return "stick actions";
    case QuantitySection::kHold:
      return "holding";
    case QuantitySection::kHoldActions:
      return "actions while holding";
    case QuantitySection::kPeaks:
      return "peaks (worst flight)";
    case QuantitySection::kOutcome:
    case QuantitySection::kFlight:
      break;
  }
  return "";
}

std::string FormatFlightMetrics(const FlightSummary& summary) {
  std::string text = InTwoColumns(summary, QuantitySection::kFlight);
  text += InCommandColumns(summary, QuantitySection::kActions);
  text += InTwoColumns(summary, QuantitySection::kHold);
  text += InCommandColumns(summary, QuantitySection::kHoldActions);
  text += InTwoColumns(summary, QuantitySection::kPeaks);
  text.pop_back();
  return text;
}

}  // namespace skein
