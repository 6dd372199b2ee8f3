// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/choice_error.h"
#include "envs/air/gravity.h"
#include "src/config/usage_error.h"
#include "src/fdm/fdm_plant.h"
#include "src/fdm/flight_grid.h"

namespace skein {

/// Which aircraft flies, in what air and under what gravity.
struct ModelOptions {
  std::string aircraft = "f16";
  std::string atmosphere = "stevens_lewis";
  Gravity gravity;

  /// The file of an own aircraft.
  std::vector<std::string> FilesRead() const;
};

/// --aircraft, --atmosphere, --gravity-ft-s2, --gravity-falls-with-altitude.
void AddModel(CLI::App* command, ModelOptions* options);

/// A flight condition of `skein fdm`: an aircraft, in steady flights.
struct FlightCondition {
  ModelOptions model;
  PlantSetting setting;
  FlightGrid grid;

  /// Throws UsageError, also without a speed or Mach number, and what LoadAircraft throws.
  Plant MakePlant() const;
  /// "f16 at 15000 ft and 500 ft/s, ..., cg 0.3"; with the wind, if there is one.
  std::string Describe(const Plant& plant) const;
  /// What a document of results begins with.
  nlohmann::ordered_json ToJson(const Plant& plant) const;
};

/// What `at` returns of the flights of a grid of that plant. A flight that there is not is named on
/// the error stream; the Error of the only one, a ChoiceError if there is none at all, and what
/// CheckSize throws, are thrown.
template <typename Result>
std::vector<Result> AtEveryPoint(const Plant& plant, const FlightGrid& grid,
                                 const std::function<Result(const SteadyFlightRequest&)>& at) {
  grid.CheckSize();
  std::vector<Result> results;
  for (std::size_t i = 0; i < grid.altitude_ft.size(); ++i) {
    for (std::size_t k = 0; k < grid.speeds().size(); ++k) {
      try {
        results.push_back(at(grid.At(plant, i, k)));
      } catch (const UsageError&) {
        throw;
      } catch (const Error& error) {
        if (grid.IsOnePoint()) throw;
        fmt::print(stderr, "note: {}\n", error.what());
      }
    }
  }
  if (results.empty()) throw ChoiceError("there is no steady flight at any of these points");
  return results;
}

/// As wide as a page's text, points.
inline constexpr double kPictureWidth = 7.2 * 72;

/// --picture, which draws `what`.
void AddPicture(CLI::App* command, const std::string& what, std::string* picture);

/// --wind-fps, which ReadWind reads: north, east, down. Throws UsageError.
void AddWind(CLI::App* command, std::string* wind);
Eigen::Vector3d ReadWind(const std::string& wind);

/// Which flight conditions a command takes.
struct FlightConditionForm {
  bool is_one_point = false;  ///< no grid of altitudes and speeds, no Mach number
  bool may_turn = true;       ///< turns and pull-ups, too
};

/// The options of a condition; `options` are to outlive `command`.
void AddFlightCondition(CLI::App* command, FlightCondition* options,
                        const FlightConditionForm& form = {});

}  // namespace skein
