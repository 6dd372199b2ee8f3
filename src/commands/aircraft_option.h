// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace skein {

/// Help of an option that takes what LoadAircraft does: `what` it is for, and the names.
std::string AircraftHelp(const std::string& what);

/// Adds --aircraft, which chooses what flies (src/config/aircraft_choice.h).
CLI::Option* AddAircraftOption(CLI::App* command, std::string* aircraft);

/// The files among what --aircraft and --set env.aircraft=... name.
std::vector<std::string> AircraftFilesIn(const std::string& aircraft,
                                         const std::vector<std::string>& assignments = {});

/// For an option that names an aircraft: shells complete the names. What is none is refused where
/// it is read.
CLI::Validator CompletesAircraft();

}  // namespace skein
