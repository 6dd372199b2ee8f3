// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/report/run_record.h"

namespace skein {

/// Deterministic success at which a policy counts as trained.
inline constexpr double kTrainedSuccess = 0.95;

/// What the iterations of a training took by the clock, over all its resumes; its final evaluation
/// and report are no part of it.
struct TrainingTimes {
  double seconds = 0;
  /// To the end of the first iteration whose evaluation came to kTrainedSuccess; nothing if none
  /// did. It is as fine as evaluations are frequent.
  std::optional<double> seconds_to_trained;
  /// Name and share of `seconds`; they sum to 1. The environment's part of a rollout is the mean of
  /// the threads', and policy is the rest of it; optimiser is what of an update is not gradients.
  std::vector<std::pair<std::string, double>> shares;
};

/// Nothing if an iteration's times are not known: a run that an older version has begun.
std::optional<TrainingTimes> TimesOf(const RunRecord& run);

/// seconds, seconds_to_95_percent (null if it never was), shares, and program: what writes this.
nlohmann::ordered_json ToJson(const TrainingTimes& times);

/// For people, a line each: the seconds, and the shares of them.
std::string ToText(const TrainingTimes& times);
std::string SharesText(const TrainingTimes& times);

}  // namespace skein
