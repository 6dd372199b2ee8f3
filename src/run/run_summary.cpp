// SPDX-License-Identifier: Apache-2.0
#include "src/run/run_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "src/config/configuration.h"
#include "src/files/output_file.h"
#include "src/run/progress.h"

namespace skein {
namespace {

namespace fs = std::filesystem;

/// Control steps flown, from the last whole row of metrics.csv.
double StepsFlown(const std::string& run) {
  const std::string path = run + "/metrics.csv";
  if (!fs::exists(path)) return 0;
  const std::string text = ReadFile(path, kLargestRecord);
  const std::size_t end = text.rfind('\n');
  if (end == std::string::npos || end == 0) return 0;
  const std::size_t begin = text.rfind('\n', end - 1);
  if (begin == std::string::npos) return 0;  // the header alone
  const std::size_t comma = text.find(',', begin);
  return comma < end ? std::strtod(text.c_str() + comma + 1, nullptr) : 0;
}

std::string SuccessOf(const std::string& run) {
  const std::string path = run + "/evaluation.json";
  if (!fs::exists(path)) return "-";
  const auto evaluation = nlohmann::json::parse(ReadFile(path), nullptr, false);
  const auto rate = evaluation.is_object() ? evaluation.find("success_rate") : evaluation.end();
  return rate == evaluation.end() || !rate->is_number()
             ? "-"
             : fmt::format("{:.1f} %", 100 * rate->get<double>());
}

std::string StateOf(const std::string& run) {
  if (IsHeld(run)) return "running";
  return fs::exists(run + "/evaluation.json") ? "finished" : "stopped";
}

RunSummary Summarise(const std::string& run) {
  try {
    const ProgramConfig config = ReadRecord(run + "/config.toml");
    return {run,
            config.train.env.task,
            config.train.env.aircraft,
            fmt::format("{} of {}", FormatCount(StepsFlown(run)),
                        FormatCount(static_cast<double>(config.train.total_steps))),
            SuccessOf(run),
            StateOf(run)};
  } catch (const Error& error) {
    return {run, "-", "-", "-", "-", error.what()};
  }
}

}  // namespace

std::vector<RunSummary> SummariseRuns(const std::string& root) {
  std::vector<std::string> paths;
  std::error_code absent;
  for (const auto& entry : fs::directory_iterator(root, absent)) {
    if (IsRunDirectory(entry.path().string())) paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<RunSummary> runs;
  runs.reserve(paths.size());
  for (const std::string& path : paths) runs.push_back(Summarise(path));
  return runs;
}

}  // namespace skein
