// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace skein {

/// `file` as the aircraft's files are written: objects one key a line, short lists of numbers on
/// one.
std::string AircraftText(const nlohmann::ordered_json& file);

}  // namespace skein
