// SPDX-License-Identifier: Apache-2.0
#include "src/report/run_report.h"

#include <fmt/format.h>

#include "base/error.h"
#include "src/report/report_data.h"
#include "src/report/report_page.h"

namespace skein {

void ReportFinishedRun(const std::string& run, WorkerPool& pool) {
  if (pool.stopping()) return;
  constexpr int kEpisodes = 200;
  try {
    ReportRequest request;
    request.runs = {run};
    request.episodes = kEpisodes;
    const std::string path = run + "/report.html";
    ReportTemplate();
    WriteReport(path, ReportData(request, pool));
    fmt::print("report          {}\n", path);
  } catch (const Error& error) {
    fmt::print("report          none: {}\n", error.what());
  }
}

}  // namespace skein
