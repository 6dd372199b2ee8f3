// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "src/export/export_form.h"

namespace skein {

/// What is exported, and where to.
struct PolicyExport {
  std::string policy;  ///< policy file, checkpoint or directory of a run
  ExportForm form = ExportForm::kC;
  std::string out;
  bool check = false;
  std::string aircraft_file = {};  ///< is read, too, and kept (KeepAircraftFile); empty: none
  std::string name = {};           ///< of functions and models, an identifier; empty: the task
};

/// Writes the policy, and of a high-level policy its low-level policy (OUT with ".low_level" before
/// its extension), as ONNX both in one graph where their rates allow it (".combined"), and a
/// manifest that says how they act together (OUT with the extension ".json"). A given name is its
/// own, the low-level policy's with "_low_level" behind it. Returns what was done, line by line,
/// and which files of those names are there, and not of this export. Throws Error if something
/// cannot be read, written or, where `check` asks for it, flown as the policy itself, and
/// ChoiceError if a file that is read would be lost. The first file is written when all are made
/// and checked; if a later one cannot be written, those before it stay.
std::vector<std::string> ExportPolicy(const PolicyExport& options);

/// Writes the flight control laws that `policy` flies through, of `aircraft` if there is none, as
/// C.
std::vector<std::string> ExportFlightControl(const std::string& policy, const std::string& aircraft,
                                             const std::string& out, bool check);

}  // namespace skein
