// SPDX-License-Identifier: Apache-2.0
#include "src/fdm/flight_grid.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/number_text.h"
#include "envs/air/atmosphere.h"
#include "envs/aircraft/units.h"
#include "envs/state/state.h"
#include "src/config/usage_error.h"
#include "src/fdm/fdm_plant.h"
#include "src/files/csv_text.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostPoints = 100000;
constexpr std::size_t kWidestMap = 88;  // columns of a terminal, less the altitudes

struct LimitWords {
  FlightLimit limit;
  char letter;
  const char* words;
};
constexpr std::array<LimitWords, 6> kLimits = {
    {{FlightLimit::kStall, 's', "below stall speed"},
     {FlightLimit::kControls, 'c', "no balance within the range of the surfaces"},
     {FlightLimit::kAlphaTables, 'a', "alpha outside the tables"},
     {FlightLimit::kThrust, 't', "thrust is short"},
     {FlightLimit::kIdle, 'i', "idle thrust is too much"},
     {FlightLimit::kEngineTables, 'e', "outside the engine's tables"}}};

const LimitWords& Of(FlightLimit limit) { return kLimits[static_cast<std::size_t>(limit)]; }

std::optional<FlightLimit> FirstLimit(const GridPoint& point) {
  if (point.IsFlown()) return std::nullopt;
  return point.limits.front().limit;
}

GridPoint Fly(const Plant& plant, const SteadyFlightRequest& request) {
  GridPoint point{request, std::nullopt, {}};
  try {
    point.flight = FindSteadyFlight(plant, request);
    point.limits = point.flight->exceeded_limits;
  } catch (const UsageError&) {
    throw;
  } catch (const Error& error) {
    point.limits = LimitsOnTheWay(plant, ToTrimRequest(plant, request));
    // What lies outside the tables is not why: an engine is no matter of balance.
    if (point.limits.empty() || point.limits.front().limit == FlightLimit::kEngineTables) {
      point.limits.insert(point.limits.begin(), {FlightLimit::kControls, error.what()});
    }
  }
  std::stable_sort(
      point.limits.begin(), point.limits.end(),
      [](const ExceededLimit& a, const ExceededLimit& b) { return a.limit < b.limit; });
  return point;
}

/// What is written of every point behind altitude and speed, by the names of its columns.
std::vector<std::pair<const char*, double>> Figures(const SteadyFlight& flight) {
  const Controls& controls = flight.trim.controls;
  std::vector<std::pair<const char*, double>> figures = {
      {"thrust_lbf", controls.thrust_lbf},
      {"available_thrust_lbf", flight.available_thrust_lbf},
      {"excess_power_fps", flight.excess_power_ft_s},
      {"ground_speed_fps", flight.ground_speed_ft_s()},
      {"throttle", flight.throttle},
      {"power", flight.trim.power},
      {"elevator_deg", controls.elevator_deg},
      {"aileron_deg", controls.aileron_deg},
      {"rudder_deg", controls.rudder_deg},
      {"leading_edge_flap_deg", controls.leading_edge_flap_deg}};
  for (const auto& [name, number] : flight.Numbers()) figures.emplace_back(name, number);
  return figures;
}

std::string Reason(const GridPoint& point) {
  return fmt::format("{}", fmt::join(WordsOf(point.limits), ", and "));
}

}  // namespace

char LetterOf(std::optional<FlightLimit> limit) { return limit ? Of(*limit).letter : '.'; }

const char* WordsOf(std::optional<FlightLimit> limit) { return limit ? Of(*limit).words : "flown"; }

SteadyFlightRequest FlightGrid::At(const Plant& plant, std::size_t altitude,
                                   std::size_t speed) const {
  SteadyFlightRequest request = manoeuvre;
  request.altitude_ft = altitude_ft[altitude];
  request.true_airspeed_ft_s =
      mach.empty() ? speed_fps[speed]
                   : mach[speed] * AirAt(plant.atmosphere(), request.altitude_ft).sound_speed_ft_s;
  return request;
}

void FlightGrid::CheckSize() const {
  if (CountPoints() <= kMostPoints) return;
  throw UsageError(fmt::format("{} points are more than {}", CountPoints(), kMostPoints));
}

FlownGrid::FlownGrid(const Plant& plant, FlightGrid grid) : grid_(std::move(grid)) {
  grid_.CheckSize();
  for (std::size_t i = 0; i < grid_.altitude_ft.size(); ++i) {
    for (std::size_t k = 0; k < grid_.speeds().size(); ++k) {
      points_.push_back(Fly(plant, grid_.At(plant, i, k)));
    }
  }
}

std::string FlownGrid::Map() const {
  std::string text = fmt::format("\naltitude, ft   {}: {:.6g} to {:.6g}\n",
                                 grid_.mach.empty() ? "speed, ft/s" : "Mach",
                                 grid_.speeds().front(), grid_.speeds().back());
  std::vector<bool> seen(kLimits.size());
  for (std::size_t i = grid_.altitude_ft.size(); i-- > 0;) {
    text += fmt::format("{:>12}   ", ShortestText(grid_.altitude_ft[i]));
    for (std::size_t k = 0; k < grid_.speeds().size(); ++k) {
      const auto limit = FirstLimit(At(i, k));
      if (limit) seen[static_cast<std::size_t>(*limit)] = true;
      text += LetterOf(limit);
    }
    text += "\n";
  }
  text += fmt::format("{:15}. {}", "", WordsOf(std::optional<FlightLimit>()));
  for (const LimitWords& limit : kLimits) {
    if (!seen[static_cast<std::size_t>(limit.limit)]) continue;
    text += fmt::format("; {} {}", limit.letter, limit.words);
  }
  return text + "\n";
}

std::string FlownGrid::GroundCell(const std::string& text) const {
  return grid_.manoeuvre.HasWind() ? fmt::format("{:>15}", text) : "";
}

std::string FlownGrid::DescribeRow(std::size_t altitude) const {
  const std::size_t count = grid_.speeds().size();
  std::size_t slowest = count, fastest = 0;
  double most_excess = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const GridPoint& point = At(altitude, k);
    if (!point.IsFlown()) continue;
    slowest = std::min(slowest, k);
    fastest = k;
    most_excess = std::max(most_excess, point.flight->excess_power_ft_s);
  }
  const std::string label = fmt::format("{:>12}", ShortestText(grid_.altitude_ft[altitude]));
  const auto beyond = [&](std::size_t k) {
    return k < count ? WordsOf(FirstLimit(At(altitude, k))) : "end of the grid";
  };
  if (slowest == count) {
    return fmt::format("{}{:>10}{:>10}{}{:>13}   {}; {}\n", label, "none", "none", GroundCell(""),
                       "", beyond(0), beyond(count - 1));
  }
  const std::string over_ground =
      fmt::format("{:.0f} to {:.0f}", At(altitude, slowest).flight->ground_speed_ft_s(),
                  At(altitude, fastest).flight->ground_speed_ft_s());
  return fmt::format("{}{:>10.6g}{:>10.6g}{}{:>13.0f}   {}; {}\n", label, grid_.speeds()[slowest],
                     grid_.speeds()[fastest], GroundCell(over_ground), most_excess,
                     beyond(slowest == 0 ? count : slowest - 1), beyond(fastest + 1));
}

std::string FlownGrid::Describe() const {
  std::string text = grid_.speeds().size() <= kWidestMap ? Map() : "";
  text += fmt::format("\n{:>12}{:>10}{:>10}{}{:>13}   {}\n", "altitude, ft", "slowest", "fastest",
                      GroundCell("over ground"), "excess ft/s", "what ends it below; above");
  for (std::size_t i = grid_.altitude_ft.size(); i-- > 0;) text += DescribeRow(i);
  return text;
}

std::string FlownGrid::Csv() const {
  std::string text = "altitude_ft,speed_fps,flown,limit,reason";
  for (const auto& [name, number] : Figures(SteadyFlight())) text += std::string(",") + name;
  const std::size_t columns = Figures(SteadyFlight()).size();
  text += "\n";
  for (const GridPoint& point : points_) {
    text += fmt::format("{},{},{},{},{}", ShortestText(point.request.altitude_ft),
                        ShortestText(point.request.true_airspeed_ft_s), point.IsFlown() ? 1 : 0,
                        point.IsFlown() ? "" : WordsOf(FirstLimit(point)),
                        point.IsFlown() ? "" : CsvText(Reason(point)));
    if (point.flight) {
      for (const auto& [name, number] : Figures(*point.flight)) text += "," + ShortestText(number);
    } else {
      text += std::string(columns, ',');
    }
    text += "\n";
  }
  return text;
}

Json ToJson(const SteadyFlight& flight) {
  const RigidBodyState& state = flight.trim.state;
  const RigidBodyState& rate = flight.output.state_rate;
  Json json = {{"state", std::vector<double>(state.data(), state.data() + state.size())},
               {"controls", ToNumbers(flight.trim.controls)},
               {"power", flight.trim.power},
               {"throttle", flight.throttle},
               {"available_thrust_lbf", flight.available_thrust_lbf},
               {"excess_power_fps", flight.excess_power_ft_s},
               {"ground_velocity_fps", {rate[kNorth], rate[kEast], rate[kDown]}},
               {"within_model", flight.exceeded_limits.empty()},
               {"exceeded_limits", WordsOf(flight.exceeded_limits)}};
  for (const auto& [name, number] : flight.Numbers()) json[name] = number;
  return json;
}

Json ToJson(const GridPoint& point) {
  Json json = {{"altitude_ft", point.request.altitude_ft},
               {"speed_fps", point.request.true_airspeed_ft_s},
               {"flown", point.IsFlown()}};
  if (!point.IsFlown()) {
    json["limit"] = WordsOf(FirstLimit(point));
    json["reason"] = Reason(point);
  }
  if (point.flight) json.update(ToJson(*point.flight));
  return json;
}

}  // namespace skein
