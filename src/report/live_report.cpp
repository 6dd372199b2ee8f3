// SPDX-License-Identifier: Apache-2.0
#include "src/report/live_report.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

namespace skein {
namespace {

namespace fs = std::filesystem;

/// When the files that a report reads were written, and how long they are: another text when one of
/// them changes.
std::string WrittenState(const std::vector<std::string>& runs) {
  std::string state;
  std::error_code failure;
  for (const std::string& run : runs) {
    for (const char* file : {"config.toml", "metrics.csv", "evaluation.json",
                             "checkpoints/policy-best.skein", "checkpoints/policy-final.skein"}) {
      const fs::path path = fs::path(run) / file;
      const auto time = fs::last_write_time(path, failure).time_since_epoch().count();
      state += fmt::format("{} {} ", failure ? 0 : time, fs::file_size(path, failure));
    }
  }
  return state;
}

}  // namespace

LiveReport::LiveReport(ReportRequest request, WorkerPool& pool)
    : request_(std::move(request)), pool_(pool) {}

const std::string& LiveReport::Data() {
  const std::string written = WrittenState(request_.runs);
  if (written != written_) {
    data_ = ReportData(request_, pool_);
    written_ = written;
  }
  return data_;
}

}  // namespace skein
