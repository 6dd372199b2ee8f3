// SPDX-License-Identifier: Apache-2.0
#include "src/evaluation/comparison.h"

#include <cmath>
#include <utility>

#include "base/error.h"
#include "src/config/conditions.h"
#include "train/ranks/shared_episodes.h"

namespace skein {
namespace {

/// Of the episodes that have a value by both agents.
PairedShares DifferenceOfShares(const std::vector<double>& first,
                                const std::vector<double>& second) {
  int only_first = 0, only_second = 0, both_known = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (std::isnan(first[i]) || std::isnan(second[i])) continue;
    ++both_known;
    only_first += first[i] > second[i];
    only_second += second[i] > first[i];
  }
  return CompareShares(only_first, only_second, both_known);
}

Estimate DifferenceOfMeans(const std::vector<double>& first, const std::vector<double>& second) {
  std::vector<double> differences;
  differences.reserve(first.size());
  for (std::size_t i = 0; i < first.size(); ++i) differences.push_back(second[i] - first[i]);
  return EstimateMean(differences);
}

PairedDifferences Differences(const std::vector<Quantity>& quantities,
                              const std::vector<Episode>& first, const std::vector<Episode>& second,
                              double control_interval_s) {
  PairedDifferences paired;
  for (const Quantity& quantity : quantities) {
    const std::vector<double> a = ValuesOf(quantity, first, control_interval_s);
    const std::vector<double> b = ValuesOf(quantity, second, control_interval_s);
    switch (quantity.statistic) {
      case Statistic::kMean:
        paired.estimates.push_back(DifferenceOfMeans(a, b));
        break;
      case Statistic::kShare:
        paired.estimates.push_back(DifferenceOfShares(a, b).difference);
        break;
      case Statistic::kLowest:
      case Statistic::kHighest:
      case Statistic::kPerHour:
        paired.estimates.push_back(EstimateMean({}));
    }
  }
  const Quantity& success = quantities[kSuccessQuantity];
  paired.success_p_value = DifferenceOfShares(ValuesOf(success, first, control_interval_s),
                                              ValuesOf(success, second, control_interval_s))
                               .p_value;
  return paired;
}

}  // namespace

void CheckEachAgentsOwn(const EnvConfig& env, const EnvConfig& origin) {
  if (env.action_repeat != origin.action_repeat) {
    throw Error("env.action_repeat cannot be set here: every agent acts at its own rate");
  }
  if (env.tracking.error_axes != origin.tracking.error_axes) {
    throw Error(
        "env.tracking.error_axes cannot be set here: every agent sees errors in its own axes");
  }
  if (env.high_level.averages_observations != origin.high_level.averages_observations) {
    throw Error(
        "env.high_level.averages_observations cannot be set here: every high-level policy "
        "observes as it was trained");
  }
}

Comparison Compare(const std::vector<NamedAgent>& agents, const ProgramConfig& config, int episodes,
                   std::uint64_t seed, WorkerPool& pool, Ranks& ranks) {
  const EnvConfig& episodes_env = config.train.env;
  Comparison comparison;
  comparison.task = episodes_env.task;
  comparison.episodes = episodes;
  comparison.seed = seed;
  comparison.control_interval_s = episodes_env.control_interval_s;
  comparison.conditions = DescribeEvaluation(episodes_env);
  comparison.quantities = QuantitiesOf(episodes_env);
  EvaluationOptions options;
  options.episodes = episodes;
  options.seed = seed;
  options.flight_metrics = true;
  std::vector<std::vector<Episode>> flown_before;
  for (const NamedAgent& named : agents) {
    const EnvConfig env = named.agent.EnvironmentFor(episodes_env);
    FlownEpisodes flown = FlyEpisodesOnRanks(named.agent, env, options, pool, ranks);
    if (flown.stopped) return comparison;
    ComparedAgent compared{
        named.name, env.action_repeat, SummariseFlights(flown.episodes, env), {}};
    if (comparison.agents.empty()) {
      comparison.starts = flown.starts;
    } else if (flown.starts != comparison.starts) {
      throw Error(named.name + " was given other episodes than " + agents[0].name +
                  ": they cannot be compared");
    }
    for (const std::vector<Episode>& before : flown_before) {
      compared.against.push_back(
          Differences(comparison.quantities, before, flown.episodes, env.control_interval_s));
    }
    flown_before.push_back(std::move(flown.episodes));
    comparison.agents.push_back(std::move(compared));
  }
  return comparison;
}

}  // namespace skein
