// SPDX-License-Identifier: Apache-2.0
#include "src/report/run_report.h"

#include <fmt/format.h>

#include <exception>

#include "src/files/output_file.h"
#include "src/report/report_data.h"
#include "src/report/report_page.h"
#include "src/report/training_times.h"

namespace skein {
namespace {

/// What a training took, on the standard output and in RUN/summary.json; no more of a failure than
/// a missing page is.
void SayTimes(const std::string& run) {
  try {
    const std::optional<TrainingTimes> times = TimesOf(ReadRunRecord(run));
    if (!times) return;
    fmt::print("{}\n", ToText(*times));
    WriteJson(run + "/summary.json", ToJson(*times));
  } catch (const std::exception& error) {
    fmt::print("summary         none: {}\n", error.what());
  }
}

}  // namespace

void WriteReportAtEnd(const std::string& path, const std::function<std::string()>& data,
                      bool is_default) {
  if (!FindReportTemplate()) {
    // In a line of a terminal: what a training prints at its end is to fit a screen.
    fmt::print("report          none: built without it (scripts/setup --viewer, scripts/build)\n");
    return;
  }
  try {
    CheckWritable(path);
    const std::string page = data(), name = OutputName(path, is_default);
    WriteReport(path, page);
    fmt::print("report          {}\n", name);
  } catch (const std::exception& error) {
    fmt::print("report          none: {}\n", error.what());
  }
}

void ReportFinishedRun(const std::string& run, WorkerPool& pool) {
  if (pool.stopping()) return;
  SayTimes(run);
  constexpr int kEpisodes = 200;
  WriteReportAtEnd(run + "/report.html", [&] {
    ReportRequest request;
    request.runs = {run};
    request.episodes = kEpisodes;
    return ReportData(request, pool);
  });
}

}  // namespace skein
