// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
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

std::string DescribeTrim(const SteadyFlight& flight) {
  const auto& trim = flight.trim;
  const auto& output = flight.output;
  std::string text;
  for (const ExceededLimit& limit : flight.exceeded_limits) {
    text += "  this flight " + limit.words + "\n";
  }
  text += fmt::format(
      "  thrust           {:14.6f} lbf   (engine power {:.4f} %, throttle {:.4f})\n"
      "  alpha            {:14.6f} deg\n"
      "  beta             {:14.6f} deg\n"
      "  bank             {:14.6f} deg\n"
      "  pitch            {:14.6f} deg\n"
      "  elevator         {:14.6f} deg\n"
      "  aileron          {:14.6f} deg\n"
      "  rudder           {:14.6f} deg\n"
      "  leading-edge flap{:14.6f} deg\n"
      "  load factor nz   {:14.6f} g\n"
      "  lift coefficient {:14.6f}\n"
      "  drag coefficient {:14.6f}\n"
      "  Mach             {:14.6f}\n"
      "  dynamic pressure {:14.6f} lbf/ft2\n"
      "  excess power     {:14.6f} ft/s at full throttle ({:.1f} lbf)\n"
      "  residual         {:14.3e} ft/s2 or rad/s2\n",
      trim.controls.thrust_lbf, trim.power, flight.throttle, trim.alpha_rad * kDegPerRad,
      output.air.beta_rad * kDegPerRad, trim.bank_rad * kDegPerRad, trim.pitch_rad * kDegPerRad,
      trim.controls.elevator_deg, trim.controls.aileron_deg, trim.controls.rudder_deg,
      trim.controls.leading_edge_flap_deg, output.nz, flight.lift_coefficient(),
      flight.drag_coefficient(), output.air.mach, output.air.dynamic_pressure_psf,
      flight.excess_power_ft_s, flight.available_thrust_lbf, trim.residual);
  return text;
}

std::string DescribeGroundVelocity(const SteadyFlight& flight) {
  const RigidBodyState& rate = flight.output.state_rate;
  return fmt::format("  over ground      {:14.6f} ft/s north, {:.6f} east, {:.6f} down\n",
                     rate[kNorth], rate[kEast], rate[kDown]);
}

void TrimOnePoint(const TrimOptions& options, const Plant& plant) {
  const FlightGrid& grid = options.condition.grid;
  const SteadyFlight flight = FindSteadyFlight(plant, grid.At(0, 0));
  fmt::print("steady flight of {}\n{}{}", options.condition.Describe(plant), DescribeTrim(flight),
             options.wind.empty() ? "" : DescribeGroundVelocity(flight));
  if (options.json.empty()) return;
  Json json = options.condition.ToJson(plant);
  json["altitude_ft"] = grid.altitude_ft.front();
  json["speed_fps"] = grid.speed_fps.front();
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
  const bool has_altitudes = grid.altitude_ft.size() > 1, has_speeds = grid.speed_fps.size() > 1;
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
