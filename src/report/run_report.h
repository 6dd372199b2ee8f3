// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "base/worker_pool.h"

namespace skein {

/// Writes a page of what has just been done, and says on the standard output where it is (and,
/// where nobody asked for a file of that name (`is_default`), that it has replaced one), or why
/// there is none: that is no failure of what was done. `data` is asked for only if there can be
/// one.
void WriteReportAtEnd(const std::string& path, const std::function<std::string()>& data,
                      bool is_default = false);

/// RUN/summary.json and RUN/report.html of a run that has just finished, the page of fewer episodes
/// than skein report. Does nothing if the pool is stopping.
void ReportFinishedRun(const std::string& run, WorkerPool& pool);

}  // namespace skein
