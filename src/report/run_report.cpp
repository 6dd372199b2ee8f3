// SPDX-License-Identifier: Apache-2.0
#include "src/report/run_report.h"

#include <fmt/format.h>

#include "base/error.h"
#include "src/files/output_file.h"
#include "src/report/report_data.h"
#include "src/report/report_page.h"

namespace skein {

void WriteReportAtEnd(const std::string& path, const std::function<std::string()>& data) {
  try {
    ReportTemplate();
    CheckWritable(path);
    WriteReport(path, data());
    fmt::print("report          {}\n", path);
  } catch (const Error& error) {
    fmt::print("report          none: {}\n", error.what());
  }
}

void ReportFinishedRun(const std::string& run, WorkerPool& pool) {
  if (pool.stopping()) return;
  constexpr int kEpisodes = 200;
  WriteReportAtEnd(run + "/report.html", [&] {
    ReportRequest request;
    request.runs = {run};
    request.episodes = kEpisodes;
    return ReportData(request, pool);
  });
}

}  // namespace skein
