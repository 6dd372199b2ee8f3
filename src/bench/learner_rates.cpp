// SPDX-License-Identifier: Apache-2.0
#include "src/bench/learner_rates.h"

#include <chrono>
#include <memory>

#include "base/median.h"
#include "base/seconds_since.h"
#include "envs/vec_env.h"
#include "simd/peak.h"
#include "train/network/network.h"
#include "train/network/precision.h"
#include "train/ppo/rollout.h"
#include "train/ppo/trainer.h"
#include "train/ranks/collectives.h"
#include "train/ranks/timed_ranks.h"

namespace skein {
namespace {

/// Of the products of the low-level policy, if there is one, until the next policy step.
double LowLevelFlopsPerPolicyStep(const TrainConfig& config) {
  if (config.low_level == nullptr) return 0;
  const double actions =
      static_cast<double>(config.env.action_repeat) / config.low_level->action_repeat();
  return actions * config.low_level->FlopsPerAction();
}

/// `count` / each of the seconds.
std::vector<double> RatesOf(double count, const std::vector<double>& seconds) {
  std::vector<double> rates;
  for (const double one : seconds) rates.push_back(count / one);
  return rates;
}

/// One configuration in training, and its seconds by iteration.
struct Runner {
  Runner(const TrainConfig& config, WorkerPool& pool, TimedRanks& processes)
      : ranks(processes),
        trainer(std::make_unique<Trainer>(config, pool, processes)),
        threads(pool.threads()) {}

  void WarmUp() { trainer->Iterate(); }

  void Iterate() {
    UnionOverRanks(ranks, 0);  // what came before took ranks differently long
    const double exchanged_s = ranks.exchange_seconds(), idle_s = ranks.idle_seconds();
    const std::uint64_t exchanges_before = ranks.exchanges(), sent_before = ranks.sent_bytes();
    const auto start = std::chrono::steady_clock::now();
    const IterationReport report = trainer->Iterate();
    whole.push_back(SecondsSince(start));
    exchange.push_back(ranks.exchange_seconds() - exchanged_s);
    idle.push_back((ranks.idle_seconds() - idle_s + report.wait_seconds) / whole.back());
    exchanges = static_cast<double>(ranks.exchanges() - exchanges_before);
    sent_bytes = static_cast<double>(ranks.sent_bytes() - sent_before);
    rollout.push_back(report.rollout_seconds);
    simulator.push_back(report.simulator_seconds / report.rollout_seconds);
    update.push_back(report.update_seconds);
    gradient.push_back(report.gradient_seconds);
    efficiency.push_back((report.rollout_seconds + report.gradient_seconds) / whole.back());
    peak.push_back(MedianPeak());
  }

  double MedianPeak() const {
    const simd::Precision roof = RoofPrecision(trainer->backend().precision);
    return simd::MeasureProductPeak(roof, threads).median_gflops;
  }

  LearnerRates Rates() {
    const TrainConfig& config = trainer->config();
    const double policy_steps =
        static_cast<double>(config.ppo.num_aircraft) * config.ppo.rollout_steps;
    const double samples = policy_steps * config.ppo.epochs;
    const VecEnv env(config.env, 1, config.seed, 1, config.low_level);
    const int observed = env.observation_size();
    const NetworkLayout actor(ActorShape(config.network, observed, env.action_size()));
    const NetworkLayout critic(
        CriticShape(config.network, observed + PrivilegedSize(config.ppo, env)));
    const int steps = config.ppo.chunk_length;
    const double forward_flops = ForwardFlops(actor) + ForwardFlops(critic);
    const double backward_flops = BackwardFlops(actor, steps) + BackwardFlops(critic, steps);
    LearnerRates rates;
    rates.backend = trainer->backend();
    rates.rollout_policy_steps_per_s = policy_steps / Median(rollout);
    rates.simulator_share = Median(simulator);
    rates.rollout_flops_per_policy_step = forward_flops + LowLevelFlopsPerPolicyStep(config);
    rates.update_samples_per_s = samples / Median(update);
    rates.gradient_samples_per_s = samples / Median(gradient);
    rates.update_flops_per_sample = forward_flops + backward_flops;
    rates.peak_gflops = Median(peak);
    rates.iteration_s = Median(whole);
    rates.efficiency = Median(efficiency);
    Sums<2> means{Median(idle), Median(exchange)};
    SumOverRanks(ranks, means.size(), means.data());
    rates.exchange_share = means[0] / ranks.count();
    rates.exchange_s = means[1] / ranks.count();
    rates.exchanges = exchanges;
    rates.sent_bytes = sent_bytes;
    rates.samples = {whole, RatesOf(policy_steps, rollout), RatesOf(samples, update),
                     RatesOf(samples, gradient)};
    return rates;
  }

  TimedRanks& ranks;
  std::unique_ptr<Trainer> trainer;
  int threads;
  std::vector<double> whole, rollout, simulator, update, gradient, efficiency, idle, exchange, peak;
  double exchanges = 0, sent_bytes = 0;
};

}  // namespace

std::vector<LearnerRates> MeasureLearners(const std::vector<TrainConfig>& configs, int iterations,
                                          WorkerPool& pool, Ranks& ranks) {
  TimedRanks timed(ranks);
  std::vector<Runner> runners;
  for (TrainConfig config : configs) {
    config.evaluation.interval_iterations = 0;
    runners.emplace_back(config, pool, timed).WarmUp();
  }
  for (int i = 0; i < iterations; ++i) {
    for (Runner& runner : runners) runner.Iterate();
  }
  std::vector<LearnerRates> rates;
  for (Runner& runner : runners) rates.push_back(runner.Rates());
  return rates;
}

}  // namespace skein
