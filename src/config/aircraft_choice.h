// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "src/config/program_config.h"

namespace skein {

/// Where the directory of a run keeps the file of its aircraft, if that is no aircraft of Skein's.
inline constexpr const char* kAircraftOfRun = "aircraft.json";

/// Reads the aircraft's file if `env` names one by its path, relative to `folder` (empty: where the
/// program runs). From then on env.aircraft is NAME#HASH (KeepAircraftFile). If it is that already,
/// the file is kAircraftOfRun in `folder`, if there is one. Throws Error on a file that is no
/// aircraft, or not the one of that hash.
void KeepAircraft(const std::string& folder, EnvConfig* env);

/// `base` with what `apply` sets. If that chooses another aircraft, it comes on top of what that
/// one's file says: its centre of gravity, and its settings of the environment, unless `base` is
/// made for an aircraft whose presets serve both (PresetsOf).
ProgramConfig WithAircraft(const ProgramConfig& base,
                           const std::function<void(ProgramConfig*)>& apply);

/// Throws Error if `config`, which is `base` with a user's settings on top, flies another aircraft
/// but with nothing said of where it begins or what the task asks of it: those numbers are then of
/// the one before. Names the preset that is made for the aircraft, if there is one.
void RequireOwnScale(const ProgramConfig& base, const ProgramConfig& config);

/// The name of the first preset of the task that is made for the aircraft; empty if none is.
std::string PresetServing(const std::string& task, const std::string& aircraft);

/// The assignment that --aircraft stands for.
std::string AircraftAssignment(const std::string& aircraft);

}  // namespace skein
