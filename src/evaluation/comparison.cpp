// SPDX-License-Identifier: Apache-2.0
#include "src/evaluation/comparison.h"

#include "base/error.h"
#include "src/config/conditions.h"
#include "train/policy/evaluate.h"

namespace skein {
namespace {

PairedDifferences Differences(const std::vector<Episode>& first, const std::vector<Episode>& second,
                              double control_interval_s) {
  PairedDifferences paired;
  for (const Quantity& quantity : Quantities()) {
    std::vector<double> differences;
    differences.reserve(first.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
      differences.push_back(quantity.value(second[i], control_interval_s) -
                            quantity.value(first[i], control_interval_s));
    }
    paired.estimates.push_back(EstimateMean(differences));
  }
  int only_first = 0, only_second = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const bool by_first = first[i].termination == Termination::kTargetReached;
    const bool by_second = second[i].termination == Termination::kTargetReached;
    only_first += by_first && !by_second;
    only_second += by_second && !by_first;
  }
  const PairedShares shares =
      CompareShares(only_first, only_second, static_cast<int>(first.size()));
  paired.estimates[kSuccessQuantity] = shares.difference;
  paired.success_p_value = shares.p_value;
  return paired;
}

}  // namespace

void CheckEachAgentsOwn(const EnvConfig& env, const EnvConfig& origin) {
  if (env.action_repeat != origin.action_repeat) {
    throw Error("env.action_repeat: agents that are compared act each at their own rate");
  }
  if (env.tracking.error_axes != origin.tracking.error_axes) {
    throw Error("env.tracking.error_axes: agents that are compared see each in their own axes");
  }
  if (env.high_level.averages_observations != origin.high_level.averages_observations) {
    throw Error(
        "env.high_level.averages_observations: high-level policies that are compared observe each "
        "as they were trained");
  }
}

Comparison Compare(const std::vector<NamedAgent>& agents, const ProgramConfig& config, int episodes,
                   std::uint64_t seed, WorkerPool& pool) {
  const EnvConfig& episodes_env = config.train.env;
  Comparison comparison;
  comparison.task = episodes_env.task;
  comparison.episodes = episodes;
  comparison.seed = seed;
  comparison.control_interval_s = episodes_env.control_interval_s;
  comparison.conditions = DescribeConditions(episodes_env);
  EvaluationOptions options;
  options.episodes = episodes;
  options.seed = seed;
  options.flight_metrics = true;
  std::vector<Episode> first;
  for (const NamedAgent& named : agents) {
    const EnvConfig env = named.agent.EnvironmentFor(episodes_env);
    const FlownEpisodes flown = FlyEpisodes(named.agent, env, options, pool);
    if (pool.stopping()) return comparison;
    ComparedAgent compared{named.name,
                           env.action_repeat,
                           SummariseFlights(flown.episodes, env.control_interval_s),
                           {}};
    if (comparison.agents.empty()) {
      comparison.starts = flown.starts;
      first = flown.episodes;
    } else {
      if (flown.starts != comparison.starts) {
        throw Error(named.name + " was given other episodes than " + agents[0].name +
                    ": they cannot be compared");
      }
      compared.against_first = Differences(first, flown.episodes, env.control_interval_s);
    }
    comparison.agents.push_back(std::move(compared));
  }
  return comparison;
}

}  // namespace skein
