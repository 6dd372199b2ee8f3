// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "envs/env_config.h"
#include "src/evaluation/estimate.h"
#include "train/policy/evaluate.h"

namespace skein {

/// What people see together.
enum class QuantitySection {
  kOutcome,      ///< what came of the episodes
  kFlight,       ///< the metrics of the paper's Table 6
  kActions,      ///< how smoothly the stick actions were flown
  kHold,         ///< how the target was held
  kHoldActions,  ///< how smoothly the stick actions were flown meanwhile
  kPeaks,        ///< peaks of whole flights: of each the mean, and then the worst flight's
};

/// What the figure of many episodes is made by from theirs.
enum class Statistic {
  kMean,
  kShare,    ///< of values that are 0 or 1
  kLowest,   ///< without an interval
  kHighest,  ///< without an interval
  kPerHour,  ///< sum of values that are 0 or 1, by the hours of all flights
};

/// Which side of a quantity is the better one.
enum class BetterSide {
  kNeither,  ///< it only describes a flight, as its Mach number does
  kHigher,
  kLower,
};

/// Something that every episode has a value of.
struct Quantity {
  std::string key;        ///< in files, with its unit
  std::string symbol;     ///< in the paper's Table 6; of actions the name of the command; or empty
  std::string label;      ///< for people, with its unit
  double shown_per_unit;  ///< what people see of it: 100 for percent
  int decimals;           ///< and how exactly
  /// Of an episode flown with EvaluationOptions::flight_metrics; NaN if it has none.
  std::function<double(const Episode& episode, double control_interval_s)> value;
  QuantitySection section = QuantitySection::kOutcome;
  Statistic statistic = Statistic::kMean;
  bool is_headline = false;  ///< what is shown where there is room for few
  BetterSide better = BetterSide::kNeither;
};

/// What episodes of `env` are measured by: success (1 or 0), return, time to the target (of
/// episodes that reached it); with a dwell the time until it had been held; of missions what became
/// of targets and flights; the flight metrics in their order, but for peaks; the smoothness of
/// actions; with a hold, or in a mission of states, how targets were held; the peaks.
std::vector<Quantity> QuantitiesOf(const EnvConfig& env);
inline constexpr int kSuccessQuantity = 0, kReturnQuantity = 1, kTimeQuantity = 2;

/// Every episode's value.
std::vector<double> ValuesOf(const Quantity& quantity, const std::vector<Episode>& episodes,
                             double control_interval_s);

/// By the quantity's statistic.
Estimate EstimateOf(const Quantity& quantity, const std::vector<Episode>& episodes,
                    double control_interval_s);

}  // namespace skein
