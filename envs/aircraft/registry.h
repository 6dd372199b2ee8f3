// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "envs/aircraft/aircraft.h"

namespace skein {

/// Names of the aircraft that come with Skein.
std::vector<std::string> AircraftNames();

/// Whether `aircraft` is the path of a file: it ends in ".json" or has a "/".
bool IsAircraftPath(const std::string& aircraft);

/// The aircraft that `aircraft` stands for: a name of AircraftNames, the path of a file
/// (docs/reference/aircraft-files.md), or what KeepAircraftFile returned. Throws Error on an
/// unknown name, with the known ones, and on a file that is no aircraft, with the key.
Aircraft LoadAircraft(const std::string& aircraft);

/// Reads the file `path` and keeps its content for as long as the process lives. Returns
/// "NAME#HASH", by which EnvConfig::aircraft can name it: whatever becomes of the file, this is the
/// aircraft as it is now. The name is the file's unless `name` is given. Thread-safe. Throws as
/// LoadAircraft.
std::string KeepAircraftFile(const std::string& path, const std::string& name = "");

/// What distinguishes an aircraft.
struct AircraftIdentity {
  std::string name;
  std::string hash;  ///< AircraftDocument::hash
};

/// Of what LoadAircraft takes, and throws as it does.
AircraftIdentity IdentifyAircraft(const std::string& aircraft);

/// The text of the file of an aircraft, which LoadAircraft would read.
std::string AircraftText(const std::string& aircraft);

/// Whether `aircraft` is NAME#HASH, as KeepAircraftFile returns it.
bool IsKeptFile(const std::string& aircraft);

/// What LoadAircraft takes for the aircraft of that hash, among those that come with Skein and
/// those kept. Throws Error if there is none.
std::string FindAircraft(const AircraftIdentity& identity);

/// The aircraft whose presets serve this one: itself, unless its file names another.
std::string PresetsOf(const std::string& aircraft);

/// Settings of the environment for the aircraft, from its file: "env.hold_s=10".
std::vector<std::string> AircraftSettings(const std::string& aircraft);

}  // namespace skein
