// SPDX-License-Identifier: Apache-2.0
#include "src/evaluation/flight_file.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace skein {
namespace {

constexpr const char* kBeforeTermination = "reward";

void AppendHeader(const FlightTable& table, std::string* text) {
  *text += "episode";
  for (const std::string& name : table.names) {
    *text += "," + name;
    if (name == kBeforeTermination) *text += ",termination";
  }
  *text += "\n";
}

void AppendRow(const FlightTable& table, std::size_t episode, std::size_t row, std::string* text) {
  const auto out = std::back_inserter(*text);
  fmt::format_to(out, "{}", episode);
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    const double value = table.columns[column][row];
    *text += ",";
    if (std::isfinite(value)) fmt::format_to(out, "{:.7g}", value);
    if (table.names[column] != kBeforeTermination) continue;
    const Termination end = table.terminations[row];
    *text += ",";
    if (end != Termination::kNone) *text += kTerminationNames[static_cast<std::size_t>(end)];
  }
  *text += "\n";
}

}  // namespace

std::string FlightsCsv(const EnvConfig& env, const std::vector<RecordedFlight>& flights,
                       FlightColumns columns, const WorkerPool* pool) {
  std::string text;
  for (std::size_t episode = 0; episode < flights.size(); ++episode) {
    if (pool != nullptr && pool->stopping()) break;
    const FlightTable table = TableOf(env, flights[episode], columns);
    if (episode == 0) AppendHeader(table, &text);
    for (std::size_t row = 0; row < table.rows(); ++row) AppendRow(table, episode, row, &text);
  }
  return text;
}

}  // namespace skein
