// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "envs/actions.h"
#include "envs/low_level_flight.h"
#include "envs/tasks/observation.h"
#include "envs/tasks/task.h"

namespace skein {

/// What policies give, in their order: stick commands, and what a high-level policy asks for.
inline constexpr std::array<const char*, kActionSize> kActionNames = {"throttle", "pitch", "roll",
                                                                      "yaw"};
inline constexpr std::array<const char*, kHighLevelActionSize> kHighLevelActionNames = {
    "target_pitch", "target_yaw", "target_speed"};

/// What they observe; "scaled": in the aircraft's ReferenceUnits.
inline constexpr std::array<const char*, kObservationSize> kObservationNames = {
    "error_0_scaled",   "error_1_scaled",  "error_2_scaled",
    "altitude_scaled",  "sin_roll",        "cos_roll",
    "sin_pitch",        "cos_pitch",       "equivalent_airspeed_scaled",
    "sin_alpha",        "cos_alpha",       "sin_beta",
    "cos_beta",         "p_rad_s",         "q_rad_s",
    "r_rad_s",          "power_fraction",  "elevator_fraction",
    "aileron_fraction", "rudder_fraction", "leading_edge_flap_fraction",
    "airspeed_ratio"};

/// What policies of `task` observe: of a built-in task kObservationNames. Of a task file, what
/// leads the row is called as in the file, with "_scaled" behind it where it has a unit; last
/// actions are "last_throttle" and so on.
std::vector<std::string> ObservationNames(const Task& task);

}  // namespace skein
