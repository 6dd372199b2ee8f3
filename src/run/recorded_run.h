// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "src/config/program_config.h"
#include "src/run/run_directory.h"

namespace skein {

/// What the run in `directory` goes on with: the configuration that it recorded, and the low-level
/// policy that it began with. Throws Error if one of them cannot be read.
ProgramConfig RecordedConfig(const RunDirectory& directory);

/// In what `asked` is not what a run has recorded (Differences). A precision that is left to the
/// processor is the one that was chosen when the run began.
std::vector<std::string> DifferencesFromRecord(const ProgramConfig& recorded, ProgramConfig asked);

}  // namespace skein
