// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "src/run/run_directory.h"

namespace skein {

/// A run at a glance, in words; "-" for what is not known yet.
struct RunSummary {
  std::string path, task, aircraft;
  std::string steps;    ///< "12.3 M of 150 M" control steps
  std::string success;  ///< of the evaluation that ended it, "99.8 %"
  std::string state;    ///< "finished", "running", "stopped", or why it cannot be read
};

/// The runs directly in `root`, by name; none if there is no such folder.
std::vector<RunSummary> SummariseRuns(const std::string& root);

}  // namespace skein
