// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "src/commands/fdm_commands.h"
#include "src/commands/flight_condition.h"
#include "src/fdm/flying_qualities_report.h"
#include "src/files/output_file.h"

namespace skein {
namespace {

struct SweepOptions {
  FlightCondition condition;
  std::string json;
};

/// Throws Error of a flight that is not steady for want of thrust.
AssessedFlight Assess(const Plant& plant, const SteadyFlightRequest& request) {
  const SteadyFlight flight = FindSteadyFlight(plant, request);
  for (const ExceededLimit& limit : flight.exceeded_limits) {
    if (limit.limit == FlightLimit::kEngineTables) continue;
    throw Error(fmt::format("flight at {} ft and {} ft/s {}", request.altitude_ft,
                            request.true_airspeed_ft_s, limit.words));
  }
  return {request, AssessFlyingQualities(plant, flight.trim)};
}

void Sweep(const SweepOptions& options) {
  CheckWritable(options.json);
  const SteadyFlightRequest& manoeuvre = options.condition.grid.manoeuvre;
  if (manoeuvre.turn_rate_deg_s != 0 || manoeuvre.load_factor) {
    throw UsageError("flying qualities are of flight with level wings, without a pull-up");
  }
  const Plant plant = options.condition.MakePlant();
  const auto flights = AtEveryPoint<AssessedFlight>(
      options.condition.grid,
      [&](const SteadyFlightRequest& request) { return Assess(plant, request); });
  fmt::print("flying qualities of {}, with flight control\n\n{}", options.condition.Describe(plant),
             flights.size() == 1 ? Describe(flights.front().qualities) : DescribeLevels(flights));
  if (options.json.empty()) return;
  nlohmann::ordered_json json = options.condition.ToJson(plant);
  for (const AssessedFlight& flight : flights) json["points"].push_back(ToJson(flight));
  WriteJson(options.json, json);
}

}  // namespace

void AddSweepCommand(CLI::App* fdm) {
  auto options = std::make_shared<SweepOptions>();
  CLI::App* command = fdm->add_subcommand(
      "sweep",
      "Flying qualities with flight control: steps, levels of MIL-F-8785C, margins of the loops");
  AddFlightCondition(command, &options->condition);
  command->add_option("--json", options->json, "also write the figures here")->type_name("FILE");
  command->footer(
      "What the figures mean: docs/how-to/ask-the-model.md.\n"
      "Example: skein fdm sweep --altitude-ft 5000..35000:10000 --speed-fps 400..1000:100");
  command->callback([options] { Sweep(*options); });
}

}  // namespace skein
