// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "src/config/program_config.h"

namespace skein {

/// The settings of a configuration whose keys begin with `beginning`, as text: equal for two that
/// say the same. Task files and aircraft of a user's are in it by their hashes.
std::string SettingsText(const ProgramConfig& config, const std::string& beginning = "");

}  // namespace skein
