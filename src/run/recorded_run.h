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

/// The line, a comment with its newline, by which a run's record says what networks it was started
/// from: `words`, and a hash of the file `networks`. Empty of no file. Throws Error if it cannot be
/// read.
std::string StartComment(const std::string& words, const std::string& networks);

/// Whether the run in `directory` was started from the networks in the file `networks`, by the hash
/// in its record; where older versions recorded none, by the file's path. Empty: from fresh ones.
/// Throws Error if a file cannot be read.
bool WasStartedFrom(const RunDirectory& directory, const std::string& networks);

/// In what `asked` is not what a run has recorded (Differences). A precision that is left to the
/// processor is the one that was chosen when the run began.
std::vector<std::string> DifferencesFromRecord(const ProgramConfig& recorded, ProgramConfig asked);

}  // namespace skein
