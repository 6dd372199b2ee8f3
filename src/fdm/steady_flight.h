// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "envs/reference/trim.h"
#include "src/fdm/trim_limits.h"

namespace skein {

/// Steady flight as a user asks for it.
struct SteadyFlightRequest {
  double altitude_ft = 0;
  double true_airspeed_ft_s = 0;
  double flight_path_deg = 0;  ///< + in a climb; through the air
  double turn_rate_deg_s = 0;  ///< + to the right; a turn without sideslip
  /// Of a pull-up, with the wings level: what the force across the flight path is, in weights.
  /// Level flight has 1, a climb the cosine of its angle; below that it is a push-over.
  std::optional<double> load_factor = std::nullopt;
  /// The air's velocity, north, east, down, ft/s. The flight heads north.
  Eigen::Vector3d wind_ft_s = Eigen::Vector3d::Zero();

  bool HasWind() const { return wind_ft_s != Eigen::Vector3d::Zero(); }
  /// Neither a turn nor a pull-up.
  bool IsStraight() const { return turn_rate_deg_s == 0 && !load_factor; }
};

/// The steady flight that was found.
struct SteadyFlight {
  TrimPoint trim;      ///< with the velocity over ground
  PlantOutput output;  ///< of the equations of motion there
  /// Limits of the aircraft and its model that it exceeds.
  std::vector<ExceededLimit> exceeded_limits;
  double throttle = 0;              ///< that commands trim.power
  double available_thrust_lbf = 0;  ///< at full throttle
  /// Specific excess power at full throttle, ft/s: what the flight could climb at constant speed.
  double excess_power_ft_s = 0;

  /// What describes it beside state, controls and engine power, by the names of files and of
  /// Python.
  std::array<std::pair<const char*, double>, 10> Numbers() const;
  /// Of the aerodynamic force across and against the flight path, in the plane of symmetry.
  double lift_coefficient() const;
  double drag_coefficient() const;
  /// The horizontal part of the velocity over ground.
  double ground_speed_ft_s() const;
};

/// Throws UsageError on a turn that is a pull-up, too, and ChoiceError where there is no such
/// flight; it says which limit is in the way, if one is.
SteadyFlight FindSteadyFlight(const Plant& plant, const SteadyFlightRequest& request);

/// The trim that `request` asks for of `plant`, in still air: a steady wind does not change it.
/// Throws UsageError as above.
TrimRequest ToTrimRequest(const Plant& plant, const SteadyFlightRequest& request);

}  // namespace skein
