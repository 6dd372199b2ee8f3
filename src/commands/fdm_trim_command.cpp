// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "envs/state/attitude.h"
#include "envs/state/state.h"
#include "src/commands/fdm_commands.h"
#include "src/commands/flight_condition.h"
#include "src/config/usage_error.h"
#include "src/files/output_file.h"
#include "src/plot/drag_polar_picture.h"
#include "src/plot/flight_grid_picture.h"
#include "src/plot/picture_file.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

struct TrimOptions {
  FlightCondition condition;
  std::string wind, json, csv, picture, polar;
};

bool IsOfThrust(const ExceededLimit& limit) {
  return limit.limit == FlightLimit::kThrust || limit.limit == FlightLimit::kIdle;
}

/// In six significant digits, on the right; what is rounding is 0.
std::string Figure(double value) {
  constexpr double kRounding = 1e-9;
  return fmt::format("{:14.6g}", std::abs(value) < kRounding ? 0 : value);
}

/// Whether the engine gives the thrust that it would take.
bool IsSustained(const SteadyFlight& flight) {
  return std::none_of(flight.exceeded_limits.begin(), flight.exceeded_limits.end(), IsOfThrust);
}

/// The first lines: whether the flight lasts, and what else is beyond the model.
std::string DescribeLimits(const SteadyFlight& flight, const std::string& condition) {
  std::string text = (IsSustained(flight) ? "steady flight of " : "trim of ") + condition + "\n";
  for (const ExceededLimit& limit : flight.exceeded_limits) {
    if (IsOfThrust(limit)) {
      text.insert(0, "this flight cannot be sustained: it " + limit.words + "\n");
    } else {
      text += "  this flight " + limit.words + "\n";
    }
  }
  return text;
}

std::string DescribeTrim(const SteadyFlight& flight) {
  const TrimPoint& trim = flight.trim;
  const PlantOutput& output = flight.output;
  const Controls& controls = trim.controls;
  const std::vector<std::pair<const char*, std::string>> rows = {
      {"thrust",
       Figure(controls.thrust_lbf) + fmt::format(" lbf   (engine power {:.6g} %, throttle {:.6g})",
                                                 trim.power, flight.throttle)},
      {"alpha", Figure(trim.alpha_rad * kDegPerRad) + " deg"},
      {"beta", Figure(output.air.beta_rad * kDegPerRad) + " deg"},
      {"bank", Figure(trim.bank_rad * kDegPerRad) + " deg"},
      {"pitch", Figure(trim.pitch_rad * kDegPerRad) + " deg"},
      {"elevator", Figure(controls.elevator_deg) + " deg"},
      {"aileron", Figure(controls.aileron_deg) + " deg"},
      {"rudder", Figure(controls.rudder_deg) + " deg"},
      {"leading-edge flap", Figure(controls.leading_edge_flap_deg) + " deg"},
      {"load factor nz", Figure(output.nz) + " g"},
      {"lift coefficient", Figure(flight.lift_coefficient())},
      {"drag coefficient", Figure(flight.drag_coefficient())},
      {"Mach", Figure(output.air.mach)},
      {"dynamic pressure", Figure(output.air.dynamic_pressure_psf) + " lbf/ft2"},
      {"excess power",
       Figure(flight.excess_power_ft_s) +
           fmt::format(" ft/s at full throttle ({:.6g} lbf)", flight.available_thrust_lbf)},
      {"residual", fmt::format("{:14.3e} ft/s2 or rad/s2", trim.residual)}};
  std::string text;
  for (const auto& [name, figure] : rows) text += fmt::format("  {:17}{}\n", name, figure);
  return text;
}

std::string DescribeGroundVelocity(const SteadyFlight& flight) {
  const RigidBodyState& rate = flight.output.state_rate;
  return fmt::format("  over ground      {} ft/s north, {:.6g} east, {:.6g} down\n",
                     Figure(rate[kNorth]), rate[kEast], rate[kDown]);
}

void TrimOnePoint(const TrimOptions& options, const Plant& plant) {
  const SteadyFlightRequest request = options.condition.grid.At(plant, 0, 0);
  const SteadyFlight flight = FindSteadyFlight(plant, request);
  fmt::print("{}{}{}", DescribeLimits(flight, options.condition.Describe(plant)),
             DescribeTrim(flight), options.wind.empty() ? "" : DescribeGroundVelocity(flight));
  if (options.json.empty()) return;
  Json json = options.condition.ToJson(plant);
  json["altitude_ft"] = request.altitude_ft;
  json["speed_fps"] = request.true_airspeed_ft_s;
  json.update(ToJson(flight));
  WriteJson(options.json, json);
}

void TrimGrid(const TrimOptions& options, const Plant& plant) {
  const FlownGrid flown(plant, options.condition.grid);
  fmt::print("steady flight of {}\n{}", options.condition.Describe(plant), flown.Describe());
  if (!options.csv.empty()) WriteFile(options.csv, flown.Csv());
  if (!options.picture.empty()) {
    WritePicture(options.picture, DrawFlightGrid(flown, kPictureWidth, ""));
  }
  if (!options.polar.empty()) {
    WritePicture(options.polar, DrawDragPolars(flown, kPictureWidth, ""));
  }
  if (options.json.empty()) return;
  Json json = options.condition.ToJson(plant);
  for (const GridPoint& point : flown.points()) json["points"].push_back(ToJson(point));
  WriteJson(options.json, json);
}

/// Before the work: what cannot be written of this grid.
void RequireGridFor(const TrimOptions& options) {
  const FlightGrid& grid = options.condition.grid;
  const bool has_altitudes = grid.altitude_ft.size() > 1, has_speeds = grid.speeds().size() > 1;
  if (!grid.mach.empty() && !(options.picture.empty() && options.polar.empty())) {
    throw UsageError("--picture and --polar are drawn over --speed-fps, not over --mach");
  }
  if (!options.csv.empty() && grid.IsOnePoint()) {
    throw UsageError("--csv is for several altitudes or speeds");
  }
  if (!options.picture.empty() && !(has_altitudes && has_speeds)) {
    throw UsageError("--picture is for several altitudes and several speeds");
  }
  if (!options.polar.empty() && !has_speeds) throw UsageError("--polar is for several speeds");
}

void FindTrim(TrimOptions options) {
  RequireGridFor(options);
  for (const std::string& picture : {options.picture, options.polar}) {
    if (!picture.empty()) CheckPictureFile(picture);
  }
  CheckWritable({options.json, options.csv, options.picture, options.polar},
                options.condition.model.FilesRead());
  RequireEnding(options.json, ".json", "--json writes JSON");
  RequireEnding(options.csv, ".csv", "--csv writes CSV");
  if (!options.wind.empty()) options.condition.grid.manoeuvre.wind_ft_s = ReadWind(options.wind);
  const Plant plant = options.condition.MakePlant();
  (options.condition.grid.IsOnePoint() ? TrimOnePoint : TrimGrid)(options, plant);
}

}  // namespace

void AddTrimCommand(CLI::App* fdm) {
  auto options = std::make_shared<TrimOptions>();
  CLI::App* command = fdm->add_subcommand(
      "trim", "Find the controls of steady flight, at one point or over a grid");
  AddFlightCondition(command, &options->condition);
  AddWind(command, &options->wind);
  command->add_option("--json", options->json, "also write state, controls and air data here")
      ->type_name("FILE");
  command->add_option("--csv", options->csv, "of a grid: a line for every point")
      ->type_name("FILE");
  AddPicture(command, "where a grid is flown", &options->picture);
  command
      ->add_option("--polar", options->polar,
                   "draw the drag polar of trimmed flight at each altitude: SVG or PDF")
      ->type_name("FILE");
  command->footer(
      "Signs: elevator + trailing edge down, aileron + rolls left, rudder + yaws left.\n"
      "Examples: skein fdm trim --altitude-ft 15000 --speed-fps 500\n"
      "          skein fdm trim --altitude-ft 0..50000:5000 --speed-fps 200..1200:25 --csv "
      "envelope.csv");
  command->callback([options] { FindTrim(*options); });
}

}  // namespace skein
