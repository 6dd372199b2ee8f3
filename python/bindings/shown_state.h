// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "envs/state/state.h"

namespace skein {

struct NamedColumn {
  int column;
  const char* name;
};

/// What of the state (envs/state/state.h) is shown to Python: all that is physical.
inline constexpr std::array<NamedColumn, 24> kShownColumns = {
    {{kU, "u_fps"},
     {kV, "v_fps"},
     {kW, "w_fps"},
     {kP, "p_rad_s"},
     {kQ, "q_rad_s"},
     {kR, "r_rad_s"},
     {kNorth, "north_ft"},
     {kEast, "east_ft"},
     {kDown, "down_ft"},
     {kQ0, "q0"},
     {kQx, "qx"},
     {kQy, "qy"},
     {kQz, "qz"},
     {kPower, "power_percent"},
     {kPowerCommand, "power_command_percent"},
     {kElevator, "elevator_deg"},
     {kAileron, "aileron_deg"},
     {kRudder, "rudder_deg"},
     {kLeadingEdgeFlap, "leading_edge_flap_deg"},
     {kNz, "nz_g"},
     {kNy, "ny_g"},
     {kWindNorth, "wind_north_fps"},
     {kWindEast, "wind_east_fps"},
     {kWindDown, "wind_down_fps"}}};

}  // namespace skein
