// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace skein {

using FdmState = std::array<double, 13>;    ///< order and units of envs/state/state.h
using FdmControls = std::array<double, 5>;  ///< thrust [lbf]; elevator, aileron, rudder, flap [deg]

/// The parameters that a point or a trajectory may set.
struct FdmParameters {
  std::optional<double> cg;  ///< `xcg`, fraction of the mean chord; without it the aircraft's own
  double engine_angular_momentum = 0;  ///< `heng`, slug ft^2/s

  bool operator<(const FdmParameters& other) const {
    return std::tie(cg, engine_angular_momentum) <
           std::tie(other.cg, other.engine_angular_momentum);
  }
};

/// A state with its controls, at which the equations of motion are evaluated.
struct FdmPoint {
  FdmState state{};
  FdmControls controls{};
  FdmParameters parameters;
};

/// A change of one control, active while t_start <= t < t_end.
struct FdmPulse {
  int control_index = 0;
  double t_start = 0, t_end = 0;  ///< s
  double delta = 0;               ///< in the control's unit
};

/// An open-loop flight: the controls are the trim controls plus the pulses that are active at the
/// start of a step.
struct FdmTrajectory {
  FdmState initial_state{};
  FdmControls trim_controls{};
  FdmParameters parameters;
  std::vector<FdmPulse> pulses;
  std::vector<double> t;  ///< s, increasing from 0; where states are recorded
};

/// What a file of `skein fdm` asks for, with the document it came from (docs/reference/commands.md
/// has the schema). Results that the document already holds are ignored.
struct FdmFile {  // NOLINT(bugprone-exception-escape): seen in the JSON library's move alone
  nlohmann::ordered_json document;
  std::vector<FdmPoint> points, edge_points;
  std::vector<FdmTrajectory> trajectories;
};

/// Throws Error with one line that names the place ("points[3].state") of what is wrong.
FdmFile ReadFdmFile(const std::string& path);

}  // namespace skein
