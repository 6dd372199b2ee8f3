// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "envs/aircraft/aircraft.h"

namespace skein {

/// What an aircraft's file says, before the numbers of its model are read.
struct AircraftDocument {
  std::string name;
  std::string text;        ///< all of it
  std::string presets_of;  ///< the aircraft whose presets serve this one; empty: its own
  std::string model;       ///< "derivatives" or "tables"
  /// Sixteen hexadecimal digits that stand for its content: the numbers and names of its model,
  /// however they are written, without what is for readers, its own name and its settings.
  std::string hash;
  /// Its settings of the environment, as configuration keys and TOML values: "env.hold_s=10".
  std::vector<std::string> settings;
};

/// Reads `text`. The aircraft is called `name` unless the file says its own. Throws Error that
/// begins with `who` on text that is no JSON object within the limits (aircraft_json.h), on a name
/// that is not made of letters, digits, "_", "-" and ".", and on settings that are no values.
AircraftDocument ReadAircraftDocument(const std::string& name, std::string_view text,
                                      const std::string& who);

/// The document in the file `path`, called by the file's name if it does not say its own. Throws
/// Error that names `path`, also if it is no file that can be read.
AircraftDocument ReadAircraftDocumentFile(const std::string& path);

/// The aircraft of a document. Throws Error that names the aircraft and the key.
Aircraft MakeAircraft(const AircraftDocument& document);

}  // namespace skein
