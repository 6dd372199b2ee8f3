// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "envs/reference/closed_loop.h"
#include "src/fdm/gusts.h"

namespace skein {

/// Where the sticks are from a time on.
struct StickCommand {
  double time_s = 0;
  PilotCommands sticks;
};

/// Reads CSV of time_s (from 0 on, increasing) and any of throttle (0 to 1), pitch, roll and yaw
/// (-1 to 1); a column that is not there stays as in `trimmed`. Throws Error that names the file
/// and what is wrong.
std::vector<StickCommand> ReadStickCommands(const std::string& path, const PilotCommands& trimmed);

/// How the float64 closed loop is flown from a trim.
struct CommandedFlight {
  FlightControlMode mode = FlightControlMode::kFull;
  double step_s = 0.02;  ///< control interval
  int substeps = 1;      ///< Runge-Kutta steps in it
  double seconds = 10;
  /// The air's velocity, north, east, down, ft/s; the aircraft is trimmed in it.
  Eigen::Vector3d wind_ft_s = Eigen::Vector3d::Zero();
  GustSettings gusts;                  ///< which begin at once
  std::vector<StickCommand> commands;  ///< none: hands off

  /// Control steps, to the nearest whole number.
  long Steps() const;
};

/// The flight as CSV in columns of files of flights (docs/reference/file-formats.md): a row at time
/// 0 and one at the end of each control step. `trim` is one in still air. Throws Error if a state
/// is beyond 1e9 or no number.
std::string FlyCommands(const Plant& plant, const TrimPoint& trim, const CommandedFlight& flight);

}  // namespace skein
