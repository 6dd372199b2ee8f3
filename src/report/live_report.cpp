// SPDX-License-Identifier: Apache-2.0
#include "src/report/live_report.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>
#include <vector>

#include "base/error.h"
#include "src/agents/policy_file.h"

namespace skein {
namespace {

namespace fs = std::filesystem;

/// When the file was written, and how long it is: another text when it changes.
std::string StateOf(const std::string& path) {
  std::error_code failure;
  const auto time = fs::last_write_time(path, failure).time_since_epoch().count();
  return fmt::format("{} {} {}\n", path, failure ? 0 : time, fs::file_size(path, failure));
}

/// Of the policy that flies of the run; empty if it has none yet.
std::string PolicyState(const std::string& run) {
  try {
    return StateOf(PolicyFileOf(run));
  } catch (const Error&) {
    return "";
  }
}

/// Of what FlyRuns reads.
std::string FlownState(const std::vector<std::string>& runs) {
  std::string state;
  for (const std::string& run : runs) {
    state += StateOf(run + "/config.toml") + StateOf(run + "/evaluation.json") + PolicyState(run);
  }
  return state;
}

/// Of what grows with every iteration.
std::string TablesState(const std::vector<std::string>& runs) {
  std::string state;
  for (const std::string& run : runs) {
    state += StateOf(run + "/metrics.csv") + StateOf(run + "/timing.csv");
  }
  return state;
}

}  // namespace

LiveReport::LiveReport(ReportRequest request, WorkerPool& pool)
    : request_(std::move(request)), pool_(pool) {}

const std::string& LiveReport::Data() {
  const std::string flown = FlownState(request_.runs);
  const std::string written = flown + TablesState(request_.runs);
  if (written == written_) return data_;
  const std::vector<RunRecord> runs = ReadRuns(request_);
  if (flown != flown_) {
    flights_ = FlyRuns(runs, request_, pool_);
    flown_ = flown;
  }
  data_ = ReportData(runs, flights_, request_);
  written_ = written;
  return data_;
}

}  // namespace skein
