// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "src/config/program_config.h"

namespace skein {

/// Every key for people to read: type, range, value in `config`, meaning, and whose it is.
std::string DescribeKeys(const ProgramConfig& config);

/// docs/reference/configuration.md: every key with its type, range, meaning and values in the
/// presets.
std::string DescribeKeysMarkdown();

}  // namespace skein
