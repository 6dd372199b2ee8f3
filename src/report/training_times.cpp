// SPDX-License-Identifier: Apache-2.0
#include "src/report/training_times.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "src/bench/machine.h"
#include "src/run/progress.h"

namespace skein {
namespace {

/// The sum of a column of timing.csv; not a number if a cell is empty.
double Total(const RunRecord& run, const std::string& column) {
  const std::vector<double>* const values = run.timing.Find(column);
  if (values == nullptr) return std::nan("");
  double sum = 0;
  for (const double value : *values) sum += value;
  return sum;
}

/// The first iteration whose evaluation came to kTrainedSuccess.
std::optional<double> TrainedIteration(const RunRecord& run) {
  const std::vector<double>* const iterations = run.metrics.Find("iteration");
  const std::vector<double>* const success = run.metrics.Find("evaluation_success_rate");
  if (iterations == nullptr || success == nullptr) return std::nullopt;
  for (std::size_t row = 0; row < success->size(); ++row) {
    if ((*success)[row] >= kTrainedSuccess) return (*iterations)[row];
  }
  return std::nullopt;
}

/// To the end of an iteration.
double SecondsTo(const RunRecord& run, double iteration) {
  const std::vector<double>& iterations = *run.timing.Find("iteration");
  const std::vector<double>& whole = *run.timing.Find("whole_s");
  double sum = 0;
  for (std::size_t row = 0; row < whole.size(); ++row) {
    if (iterations[row] <= iteration) sum += whole[row];
  }
  return sum;
}

}  // namespace

std::optional<TrainingTimes> TimesOf(const RunRecord& run) {
  const double whole = Total(run, "whole_s"), rollout = Total(run, "rollout_s");
  const double update = Total(run, "update_s");
  const double simulator = Total(run, "simulator_s"), gradients = Total(run, "gradient_s");
  std::vector<std::pair<std::string, double>> parts = {{"environment", simulator},
                                                       {"policy", rollout - simulator},
                                                       {"gradients", gradients},
                                                       {"optimiser", update - gradients},
                                                       {"evaluation", Total(run, "evaluation_s")},
                                                       {"files", Total(run, "files_s")},
                                                       {"start", Total(run, "start_s")}};
  double known = 0;
  for (const auto& [name, seconds] : parts) known += seconds;
  if (!(whole > 0) || !std::isfinite(known)) return std::nullopt;
  parts.emplace_back("other", std::max(0.0, whole - known));
  TrainingTimes times;
  times.seconds = whole;
  for (const auto& [name, seconds] : parts) {
    times.shares.emplace_back(name, seconds / std::max(whole, known));
  }
  if (const auto iteration = TrainedIteration(run)) {
    times.seconds_to_trained = SecondsTo(run, *iteration);
  }
  return times;
}

nlohmann::ordered_json ToJson(const TrainingTimes& times) {
  nlohmann::ordered_json shares;
  for (const auto& [name, share] : times.shares) shares[name] = share;
  nlohmann::ordered_json trained;
  if (times.seconds_to_trained) trained = *times.seconds_to_trained;
  return {{"seconds", times.seconds},
          {"seconds_to_95_percent", trained},
          {"shares", shares},
          {"program", ProgramJson()}};
}

std::string ToText(const TrainingTimes& times) {
  const std::string trained =
      times.seconds_to_trained
          ? fmt::format("{:.0f} % deterministic success after {}", 100 * kTrainedSuccess,
                        FormatDuration(*times.seconds_to_trained))
          : fmt::format("no evaluation came to {:.0f} % success", 100 * kTrainedSuccess);
  return fmt::format("time            {}; {}", FormatDuration(times.seconds), trained);
}

std::string SharesText(const TrainingTimes& times) {
  std::vector<std::string> shares;
  for (const auto& [name, share] : times.shares) {
    shares.push_back(fmt::format("{} {:.1f} %", name, 100 * share));
  }
  return fmt::format("                {}", fmt::join(shares, ", "));
}

}  // namespace skein
