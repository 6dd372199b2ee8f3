// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/worker_pool.h"

namespace skein {

/// Writes RUN/report.html of a run that has just finished, of fewer episodes than skein report, and
/// says on the standard output where it is, or why there is none: nothing here is a failure of the
/// training. Does nothing if the pool is stopping.
void ReportFinishedRun(const std::string& run, WorkerPool& pool);

}  // namespace skein
