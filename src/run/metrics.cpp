// SPDX-License-Identifier: Apache-2.0
#include "src/run/metrics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "base/error.h"
#include "src/files/output_file.h"

namespace skein {
namespace {

std::string Cell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

/// How names of what an evaluation says begin.
constexpr std::string_view kEvaluated = "evaluation_";

double EvaluationSuccess(const IterationReport& report) {
  return report.evaluation_success_rate < 0 ? std::nan("") : report.evaluation_success_rate;
}

/// What later versions added, at the end of a row: rows of older runs end before it.
std::vector<std::pair<std::string, double>> LaterValues(const IterationReport& report) {
  return {{"action_change", report.action_change},
          {"evaluation_hold_within", report.evaluation_hold_within}};
}

/// Every other value of a row but the counters, by name: one list for CSV and TensorBoard.
std::vector<std::pair<std::string, double>> Values(const IterationReport& report) {
  return {{"return_mean", report.return_mean},
          {"success_rate", report.success_rate},
          {"evaluation_success_rate", EvaluationSuccess(report)},
          {"policy_loss", report.policy_loss},
          {"value_loss", report.value_loss},
          {"entropy", report.entropy},
          {"approximate_kl", report.approximate_kl},
          {"clip_fraction", report.clip_fraction},
          {"actor_gradient_norm", report.actor_gradient_norm},
          {"critic_gradient_norm", report.critic_gradient_norm},
          {"explained_variance", report.explained_variance},
          {"learning_rate", report.learning_rate},
          {"log_std_mean", report.log_std_mean}};
}

/// Columns of `header` that the file with the header `line` lacks.
std::size_t MissingColumns(const std::string& path, const std::string& line,
                           const std::string& header) {
  const auto columns = [](const std::string& text) {
    return std::count(text.begin(), text.end(), ',') + 1;
  };
  const auto missing = columns(header) - columns(line);
  if (missing >= 0) return static_cast<std::size_t>(missing);
  throw Error(
      fmt::format("{}: it has {} columns where this version writes {}; move it away to resume",
                  path, columns(line), columns(header)));
}

}  // namespace

std::vector<MetricsCell> MetricsCells(const IterationReport& report) {
  std::vector<MetricsCell> cells;
  const auto add_count = [&](const std::string& name, auto count) {
    cells.push_back({name, static_cast<double>(count), true});
  };
  const auto add_values = [&](const std::vector<std::pair<std::string, double>>& values) {
    for (const auto& [name, value] : values) cells.push_back({name, value, false});
  };
  add_count("iteration", report.iteration);
  add_count("env_steps", report.env_steps);
  add_count("episodes", report.episodes);
  add_values(Values(report));
  for (std::size_t kind = 1; kind < kTerminationNames.size(); ++kind) {
    add_count(fmt::format("ended_{}", kTerminationNames[kind]), report.terminations[kind]);
  }
  add_count("best", report.best ? 1 : 0);
  add_values(LaterValues(report));
  return cells;
}

std::string MetricsHeader() {
  std::vector<std::string> names;
  for (const MetricsCell& cell : MetricsCells({})) names.push_back(cell.name);
  return fmt::format("{}\n", fmt::join(names, ","));
}

std::string MetricsRow(const IterationReport& report) {
  std::vector<std::string> texts;
  for (const MetricsCell& cell : MetricsCells(report)) {
    texts.push_back(cell.is_count ? fmt::format("{:.0f}", cell.value) : Cell(cell.value));
  }
  return fmt::format("{}\n", fmt::join(texts, ","));
}

std::string TimingHeader() {
  return "iteration,env_steps,unix_time_s,rollout_s,update_s,evaluation_s,simulator_s,gradient_s,"
         "files_s,start_s,whole_s\n";
}

std::string TimingRow(const IterationReport& report, double unix_time_s, const TurnSeconds& turn) {
  std::string row = fmt::format("{},{},{:.3f}", report.iteration, report.env_steps, unix_time_s);
  for (const double seconds :
       {report.rollout_seconds, report.update_seconds, report.evaluation_seconds,
        report.simulator_seconds, report.gradient_seconds, turn.files, turn.start, turn.whole}) {
    row += fmt::format(",{:.6f}", seconds);
  }
  return row + "\n";
}

std::vector<std::pair<std::string, double>> Scalars(const IterationReport& report,
                                                    double control_steps) {
  std::vector<std::pair<std::string, double>> scalars;
  for (const auto& values : {Values(report), LaterValues(report)}) {
    for (const auto& [name, value] : values) {
      if (!std::isfinite(value)) continue;
      const bool is_evaluated = name.rfind(kEvaluated, 0) == 0;
      scalars.emplace_back(
          is_evaluated ? "eval/" + name.substr(kEvaluated.size()) : "train/" + name, value);
    }
  }
  if (report.episodes > 0) {
    for (int kind = 1; kind < kNumTerminations; ++kind) {
      const auto index = static_cast<std::size_t>(kind);
      scalars.emplace_back(
          fmt::format("ended/{}", kTerminationNames[index]),
          static_cast<double>(report.terminations[index]) / static_cast<double>(report.episodes));
    }
  }
  const double seconds = report.rollout_seconds + report.update_seconds;
  if (seconds > 0) scalars.emplace_back("time/fps", control_steps / seconds);
  scalars.emplace_back("time/rollout_s", report.rollout_seconds);
  scalars.emplace_back("time/update_s", report.update_seconds);
  return scalars;
}

std::uint64_t TrimRows(const std::string& path, std::uint64_t iteration,
                       const std::string& header) {
  if (!std::filesystem::exists(path)) return 0;
  const std::string text = ReadFile(path, kLargestRecord);
  std::string kept, row_end;
  std::uint64_t rows = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) break;  // torn by a kill in the middle of a write
    const std::string line = text.substr(begin, end - begin);
    if (begin == 0) {
      row_end = std::string(MissingColumns(path, line, header), ',') + "\n";
      kept = header;
    } else if (std::strtoull(line.c_str(), nullptr, 10) <= iteration) {
      kept += line + row_end;
      ++rows;
    }
    begin = end + 1;
  }
  if (kept != text) WriteFile(path, kept);
  return rows;
}

}  // namespace skein
