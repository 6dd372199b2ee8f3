// SPDX-License-Identifier: Apache-2.0
#include "src/evaluation/quantities.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "envs/interface_names.h"
#include "envs/task_registry.h"

namespace skein {
namespace {

constexpr double kSecondsPerMinute = 60, kSecondsPerHour = 3600;

using EpisodeValue = std::function<double(const Episode& episode, double control_interval_s)>;

double NanUnless(bool known, double value) { return known ? value : std::nan(""); }

bool IsLost(const Episode& episode) {
  return episode.termination != Termination::kTargetReached &&
         episode.termination != Termination::kTimeLimit;
}

/// The three first of every list, by their constants.
std::vector<Quantity> Outcomes(bool is_mission) {
  return {{"success_rate", "", is_mission ? "flown to the end, %" : "success, %", 100, 1,
           [](const Episode& episode, double) { return episode.succeeded ? 1.0 : 0.0; },
           QuantitySection::kOutcome, Statistic::kShare, true, BetterSide::kHigher},
          {"return", "", "return", 1, 1,
           [](const Episode& episode, double) { return episode.episode_return; },
           QuantitySection::kOutcome, Statistic::kMean, true, BetterSide::kHigher},
          {"time_to_target_s", "", "time to target, s", 1, 2,
           [](const Episode& episode, double control_interval_s) {
             return NanUnless(episode.reached_step > 0, episode.entered_step * control_interval_s);
           },
           QuantitySection::kOutcome, Statistic::kMean, !is_mission, BetterSide::kLower}};
}

void AddMission(std::vector<Quantity>* list) {
  const auto add = [list](const char* key, const char* label, Statistic statistic,
                          BetterSide better, const EpisodeValue& value) {
    list->push_back(
        {key, "", label, 1, 2, value, QuantitySection::kOutcome, statistic, true, better});
  };
  add("targets_per_minute", "targets per minute", Statistic::kMean, BetterSide::kHigher,
      [](const Episode& episode, double control_interval_s) {
        return episode.measures.targets_reached * kSecondsPerMinute /
               (episode.steps * control_interval_s);
      });
  add("targets_missed", "targets missed a flight", Statistic::kMean, BetterSide::kLower,
      [](const Episode& episode, double) { return episode.measures.targets_missed; });
  add("losses_per_hour", "losses per flight hour", Statistic::kPerHour, BetterSide::kLower,
      [](const Episode& episode, double) { return IsLost(episode) ? 1.0 : 0.0; });
}

int DecimalsOf(int metric) {
  switch (metric) {
    case kMeanTrueAirspeed:
    case kMeanClimbRate:
    case kMeanAbsClimbRate:
    case kPeakAbsP:
      return 1;
    case kMeanLoadFactor:
    case kMeanAbsAlpha:
    case kPeakLoadFactor:
    case kLowestLoadFactor:
    case kPeakAlpha:
    case kPeakAbsBeta:
      return 2;
    default:
      return 3;
  }
}

BetterSide BetterSideOf(int metric) {
  const bool is_margin = metric >= kAltitudeMargin && metric <= kBetaMargin;
  return is_margin || metric == kSmoothness ? BetterSide::kHigher : BetterSide::kNeither;
}

Quantity FlightMetricQuantity(int metric, QuantitySection section) {
  const auto index = static_cast<std::size_t>(metric);
  const FlightMetricName& name = kFlightMetricNames[index];
  return {name.key,
          name.symbol,
          name.meaning,
          1,
          DecimalsOf(metric),
          [index](const Episode& episode, double) { return episode.metrics[index]; },
          section,
          Statistic::kMean,
          false,
          BetterSideOf(metric)};
}

void AddFlightMetrics(std::vector<Quantity>* list) {
  for (int k = 0; k < kFirstPeak; ++k) {
    list->push_back(FlightMetricQuantity(k, QuantitySection::kFlight));
  }
}

void AddPeaks(std::vector<Quantity>* list) {
  for (int k = kFirstPeak; k < kNumFlightMetrics; ++k) {
    const Quantity mean = FlightMetricQuantity(k, QuantitySection::kPeaks);
    Quantity worst = mean;
    worst.key += "_worst";
    worst.label = "worst flight's " + mean.label;
    worst.statistic = k == kLowestLoadFactor ? Statistic::kLowest : Statistic::kHighest;
    list->push_back(mean);
    list->push_back(worst);
  }
}

struct SmoothnessName {
  const char *key, *label;
  double shown_per_unit;
  int decimals;
  float CommandSmoothness::*value;
};

constexpr std::array<SmoothnessName, 4> kSmoothnessNames = {{
    {"variation_per_s", "variation, 1/s", 1, 3, &CommandSmoothness::variation_per_s},
    {"reversals_per_s", "reversals, 1/s", 1, 3, &CommandSmoothness::reversals_per_s},
    {"power_above_1hz", "power > 1 Hz, %", 100, 1, &CommandSmoothness::power_above_split},
    {"saturated", "saturated, %", 100, 1, &CommandSmoothness::saturated},
}};

void AddSmoothness(ActionSmoothness FlightMeasures::*actions, QuantitySection section,
                   const char* prefix, std::vector<Quantity>* list) {
  for (const SmoothnessName& name : kSmoothnessNames) {
    for (std::size_t k = 0; k < kActionNames.size(); ++k) {
      list->push_back({fmt::format("{}{}_{}", prefix, kActionNames[k], name.key), kActionNames[k],
                       name.label, name.shown_per_unit, name.decimals,
                       [=](const Episode& episode, double) {
                         return (episode.measures.*actions)[k].*name.value;
                       },
                       section, Statistic::kMean, false, BetterSide::kLower});
    }
  }
}

/// "rms airspeed error, ft/s" of the column true_airspeed_fps.
std::string ErrorLabel(const std::string& column) {
  const std::size_t last = column.rfind('_'), first = column.find("true_") == 0 ? 5 : 0;
  const std::string unit = column.substr(last + 1);
  return fmt::format("rms {} error, {}", column.substr(first, last - first),
                     unit == "fps" ? "ft/s" : unit);
}

void AddHold(const EnvConfig& env, std::vector<Quantity>* list) {
  const auto add = [list](const std::string& key, const std::string& label, double shown_per_unit,
                          int decimals, const EpisodeValue& value, bool is_headline = false,
                          Statistic statistic = Statistic::kMean) {
    const bool is_share = key.rfind("within", 0) == 0;
    list->push_back({"hold_" + key, "", label, shown_per_unit, decimals, value,
                     QuantitySection::kHold, statistic, is_headline,
                     is_share ? BetterSide::kHigher : BetterSide::kLower});
  };
  const auto of = [](float HoldMetrics::*metric) {
    return [=](const Episode& episode, double) { return episode.measures.hold.*metric; };
  };
  add("within", "within tolerances, %", 100, 1, of(&HoldMetrics::within), true);
  add("within_lowest", "lowest flight's, %", 100, 1, of(&HoldMetrics::within), false,
      Statistic::kLowest);
  const std::vector<TargetQuantity> targets = MakeTask(env)->target_quantities();
  // Of more the errors are not measured.
  for (std::size_t k = 0; k < std::min<std::size_t>(targets.size(), kNumTaskErrors); ++k) {
    const double unit = targets[k].error_unit;
    add(fmt::format("rms_error_{}", targets[k].column), ErrorLabel(targets[k].column), 1, 2,
        [=](const Episode& episode, double) { return unit * episode.measures.hold.rms_errors[k]; });
  }
  add("rms_p_deg_s", "rms roll rate, deg/s", 1, 2, of(&HoldMetrics::rms_p), true);
  add("rms_q_deg_s", "rms pitch rate, deg/s", 1, 2, of(&HoldMetrics::rms_q));
  add("rms_r_deg_s", "rms yaw rate, deg/s", 1, 2, of(&HoldMetrics::rms_r));
  add("load_factor_deviation_g", "std. dev. of nz, g", 1, 3,
      of(&HoldMetrics::load_factor_deviation), true);
  add("rms_beta_deg", "rms sideslip, deg", 1, 2, of(&HoldMetrics::rms_sideslip));
  add("abs_bank_deg", "mean abs(bank), deg", 1, 2, of(&HoldMetrics::mean_abs_bank));
  add("net_rolls_per_min", "net rolls per minute", 1, 2, of(&HoldMetrics::net_rolls_per_min), true);
  if (env.mission.enabled()) return;
  add(
      "lost", "lost while holding, %", 100, 1,
      [](const Episode& episode, double) {
        return NanUnless(episode.reached_step > 0, IsLost(episode));
      },
      false, Statistic::kShare);
  AddSmoothness(&FlightMeasures::hold_actions, QuantitySection::kHoldActions, "hold_", list);
}

/// Those of `values` that are 1, of those that are a number.
Estimate ShareOf(const std::vector<double>& values) {
  int trials = 0, successes = 0;
  for (const double value : values) {
    trials += !std::isnan(value);
    successes += value == 1;
  }
  return EstimateShare(successes, trials);
}

/// The one of `values` that comes before all others of them that are a number.
template <typename IsBefore>
Estimate FirstOf(const std::vector<double>& values, const IsBefore& is_before) {
  Estimate first{std::nan(""), std::nan(""), std::nan(""), 0};
  for (const double value : values) {
    if (std::isnan(value)) continue;
    if (first.count == 0 || is_before(value, first.value)) first.value = value;
    ++first.count;
  }
  return first;
}

Estimate PerHour(const std::vector<double>& values, const std::vector<Episode>& episodes,
                 double control_interval_s) {
  double seconds = 0;
  for (const Episode& episode : episodes) seconds += episode.steps * control_interval_s;
  const double events = std::accumulate(values.begin(), values.end(), 0.0);
  return EstimateRate(static_cast<int>(events), seconds / kSecondsPerHour);
}

}  // namespace

std::vector<Quantity> QuantitiesOf(const EnvConfig& config) {
  const EnvConfig env = EvaluationConfig(config);
  const bool is_mission = env.mission.enabled();
  const auto task = MakeTask(env);
  std::vector<Quantity> list = Outcomes(is_mission);
  if (task->dwell_s() > 0 && !is_mission) {
    list.push_back({"time_held_s", "", "time until held, s", 1, 2,
                    [](const Episode& episode, double control_interval_s) {
                      return NanUnless(episode.reached_step > 0,
                                       episode.reached_step * control_interval_s);
                    },
                    QuantitySection::kOutcome, Statistic::kMean, true, BetterSide::kLower});
  }
  if (is_mission) AddMission(&list);
  AddFlightMetrics(&list);
  AddSmoothness(&FlightMeasures::actions, QuantitySection::kActions, "", &list);
  if (env.hold_s > 0 || (is_mission && !task->is_point())) AddHold(env, &list);
  AddPeaks(&list);
  return list;
}

std::vector<double> ValuesOf(const Quantity& quantity, const std::vector<Episode>& episodes,
                             double control_interval_s) {
  std::vector<double> values;
  values.reserve(episodes.size());
  for (const Episode& episode : episodes) {
    values.push_back(quantity.value(episode, control_interval_s));
  }
  return values;
}

Estimate EstimateOf(const Quantity& quantity, const std::vector<Episode>& episodes,
                    double control_interval_s) {
  const std::vector<double> values = ValuesOf(quantity, episodes, control_interval_s);
  switch (quantity.statistic) {
    case Statistic::kShare:
      return ShareOf(values);
    case Statistic::kLowest:
      return FirstOf(values, std::less<>());
    case Statistic::kHighest:
      return FirstOf(values, std::greater<>());
    case Statistic::kPerHour:
      return PerHour(values, episodes, control_interval_s);
    case Statistic::kMean:
      break;
  }
  return EstimateMean(values);
}

}  // namespace skein
