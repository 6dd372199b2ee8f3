// SPDX-License-Identifier: Apache-2.0
#include "src/commands/flight_condition.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "base/field_list.h"
#include "base/number_text.h"
#include "src/bench/machine.h"
#include "src/commands/aircraft_option.h"
#include "src/config/number_in.h"
#include "src/config/number_list.h"
#include "src/config/one_of.h"
#include "src/config/whole_number.h"

namespace skein {
namespace {

constexpr double kAny = -std::numeric_limits<double>::infinity();

std::string Span(const std::vector<double>& values) {
  return values.size() == 1 ? ShortestText(values.front())
                            : ShortestText(values.front()) + " to " + ShortestText(values.back());
}

std::string SpeedText(const FlightGrid& grid, const Plant& plant) {
  if (grid.mach.empty()) return Span(grid.speed_fps) + " ft/s";
  if (!grid.IsOnePoint()) return "Mach " + Span(grid.mach);
  return fmt::format("Mach {} ({:.6g} ft/s)", Span(grid.mach),
                     grid.At(plant, 0, 0).true_airspeed_ft_s);
}

void AddSpeed(CLI::App* command, FlightGrid* grid, bool is_one_point) {
  const auto add = [&](const char* name, std::vector<double>* numbers, const char* what) {
    return AddNumberList(command, name, numbers, 0, "number above 0", what);
  };
  if (is_one_point) {
    add("--speed-fps", &grid->speed_fps, "true airspeed, ft/s")->required();
    return;
  }
  CLI::Option* speed = add("--speed-fps", &grid->speed_fps, "true airspeed, ft/s: the same");
  add("--mach", &grid->mach, "Mach number in place of a speed: the same")->excludes(speed);
}

void AddFlightPath(CLI::App* command, SteadyFlightRequest* manoeuvre) {
  command
      ->add_option("--flight-path-deg", manoeuvre->flight_path_deg,
                   "flight-path angle, deg, positive in a climb")
      ->transform(NumberIn(-90, 90))
      ->capture_default_str();
}

void AddTurnAndPullUp(CLI::App* command, SteadyFlightRequest* manoeuvre) {
  CLI::Option* turn = command
                          ->add_option("--turn-rate-deg-s", manoeuvre->turn_rate_deg_s,
                                       "turn rate, deg/s, positive to the right, without sideslip")
                          ->transform(FiniteNumber())
                          ->capture_default_str();
  command
      ->add_option("--pull-up-g", manoeuvre->load_factor,
                   "pull-up with level wings: force across the flight path over weight, 1 in level "
                   "flight; less is a push-over")
      ->transform(FiniteNumber())
      ->excludes(turn);
}

void AddPlantSetting(CLI::App* command, PlantSetting* setting) {
  command
      ->add_option("--xcg", setting->cg,
                   "centre of gravity, fraction of the mean chord (default: the aircraft's own)")
      ->transform(NumberThat([](double cg) { return Bounds::PositiveFraction().Contains(cg); },
                             "number above 0, at most 1"));
  command
      ->add_option("--heng", setting->engine_angular_momentum,
                   "angular momentum of the engine, slug ft2/s")
      ->transform(FiniteNumber())
      ->capture_default_str();
  command->add_flag("--drag-rise", setting->drag_rises, "drag rises with the Mach number");
  command->add_flag("--thrust-growth", setting->thrust_grows, "thrust grows above Mach 1");
}

}  // namespace

std::vector<std::string> ModelOptions::FilesRead() const { return AircraftFilesIn(aircraft); }

void AddModel(CLI::App* command, ModelOptions* options) {
  command->add_option("--aircraft", options->aircraft, AircraftHelp("whose equations of motion"))
      ->check(CompletesAircraft())
      ->type_name("NAME_OR_FILE")
      ->capture_default_str();
  command
      ->add_option("--atmosphere", options->atmosphere,
                   "air of the published F-16 models, or U.S. Standard Atmosphere 1976")
      ->check(OneOf(AtmosphereNames()))
      ->capture_default_str();
  command
      ->add_option("--gravity-ft-s2", options->gravity.at_sea_level_ft_s2,
                   "gravity at sea level; load factors stay multiples of 32.17 ft/s2")
      ->transform(NumberAboveZero())
      ->capture_default_str();
  command->add_flag("--gravity-falls-with-altitude", options->gravity.falls_with_altitude,
                    "as in the U.S. Standard Atmosphere 1976");
}

void AddWind(CLI::App* command, std::string* wind) {
  command
      ->add_option("--wind-fps", *wind,
                   "velocity of the air, ft/s; the flight heads north, its speed and flight path "
                   "are through the air")
      ->type_name("NORTH,EAST,DOWN");
}

Eigen::Vector3d ReadWind(const std::string& text) {
  const auto numbers = ReadNumberList(text);
  if (!numbers || numbers->size() != 3) {
    throw UsageError(fmt::format("--wind-fps {}: give three numbers, NORTH,EAST,DOWN", text));
  }
  return {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

void AddPicture(CLI::App* command, const std::string& what, std::string* picture) {
  command
      ->add_option("--picture", *picture,
                   fmt::format("draw {}: SVG or PDF by the ending of the name", what))
      ->type_name("FILE");
}

void AddFlightCondition(CLI::App* command, FlightCondition* options,
                        const FlightConditionForm& form) {
  AddNumberList(
      command, "--altitude-ft", &options->grid.altitude_ft, kAny, "finite number",
      form.is_one_point ? "altitude, ft" : "altitude, ft: one, several (A,B,C) or FROM..TO:STEP")
      ->required();
  AddSpeed(command, &options->grid, form.is_one_point);
  AddFlightPath(command, &options->grid.manoeuvre);
  if (form.may_turn) AddTurnAndPullUp(command, &options->grid.manoeuvre);
  AddPlantSetting(command, &options->setting);
  AddModel(command, &options->model);
}

Plant FlightCondition::MakePlant() const {
  if (grid.speeds().empty()) throw UsageError("--speed-fps or --mach is required");
  return skein::MakePlant(model.aircraft, AtmosphereNamed(model.atmosphere), model.gravity,
                          setting);
}

std::string FlightCondition::Describe(const Plant& plant) const {
  const SteadyFlightRequest& manoeuvre = grid.manoeuvre;
  std::string text =
      fmt::format("{} at {} ft and {}, flight path {} deg, ", model.aircraft,
                  Span(grid.altitude_ft), SpeedText(grid, plant), manoeuvre.flight_path_deg);
  text += manoeuvre.load_factor
              ? fmt::format("pull-up at {} times the weight", *manoeuvre.load_factor)
              : fmt::format("turn {} deg/s", manoeuvre.turn_rate_deg_s);
  text += fmt::format(", cg {}", plant.aircraft().airframe.cg);
  if (!manoeuvre.HasWind()) return text;
  const Eigen::Vector3d& wind = manoeuvre.wind_ft_s;
  return text + fmt::format(", wind {} ft/s north, {} east, {} down", wind.x(), wind.y(), wind.z());
}

nlohmann::ordered_json FlightCondition::ToJson(const Plant& plant) const {
  const Eigen::Vector3d& wind = grid.manoeuvre.wind_ft_s;
  nlohmann::ordered_json json = {
      {"aircraft", model.aircraft},
      {"atmosphere", model.atmosphere},
      {"gravity_ft_s2", model.gravity.at_sea_level_ft_s2},
      {"gravity_falls_with_altitude", model.gravity.falls_with_altitude},
      {"flight_path_deg", grid.manoeuvre.flight_path_deg},
      {"turn_rate_deg_s", grid.manoeuvre.turn_rate_deg_s},
      {"wind_fps", {wind.x(), wind.y(), wind.z()}},
      {"params",
       {{"xcg", plant.aircraft().airframe.cg}, {"heng", setting.engine_angular_momentum}}},
      {"drag_rise", setting.drag_rises},
      {"thrust_growth", setting.thrust_grows}};
  if (grid.manoeuvre.load_factor) json["pull_up_g"] = *grid.manoeuvre.load_factor;
  json["program"] = ProgramJson();
  return json;
}

}  // namespace skein
