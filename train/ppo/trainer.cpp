// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/trainer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>

#include "base/error.h"
#include "base/fnv_hash.h"
#include "base/reason_of.h"
#include "base/seconds_since.h"
#include "envs/vec_env.h"
#include "train/policy/policy_environment.h"
#include "train/ppo/actor_critic.h"
#include "train/ppo/broken_shard.h"
#include "train/ppo/learning_rate.h"
#include "train/ppo/mean_actor.h"
#include "train/ppo/popart.h"
#include "train/ppo/ppo_update.h"
#include "train/ppo/rank_shards.h"
#include "train/ppo/reward_check.h"
#include "train/ppo/rollout.h"
#include "train/ppo/training_state.h"
#include "train/ppo/value_means.h"
#include "train/ranks/collectives.h"
#include "train/ranks/shared_episodes.h"

namespace skein {
namespace {

const TrainConfig& Validated(const TrainConfig& config) {
  ValidateLearning(config);
  if (config.low_level != nullptr) {
    CheckLowLevelMadeFor(config.env, *config.low_level, "the low-level policy");
  }
  return config;
}

}  // namespace

struct Trainer::Impl {
  Impl(const TrainConfig& training, WorkerPool& workers, Ranks& processes)
      : config(Validated(training)),
        pool(workers),
        ranks(processes),
        shards(ShardsOfRank(config, ranks)),
        env(config.env, FlownHere(), config.seed, config.learner.rollout_tile, LowLevelPolicy(),
            ranks.rank() * FlownHere()),
        networks(config, env.observation_size(), PrivilegedSize(config.ppo, env),
                 env.action_size()),
        rollout(OwnRollout(), env.observation_size(), env.action_size(), StateSize(),
                PrivilegedSize(config.ppo, env), shards),
        recurrent(FlownHere(), StateSize()),
        update(config, networks, pool, ranks),
        adapted_learning_rate(config.ppo.target_kl > 0 ? config.ppo.learning_rate : 0) {
    BeginAverage();
    config.learner.precision = networks.backend.precision;
    if (config.ppo.condition_ramp > 0) {
      env.SetConditionShare(0);
      env.Restart();
    }
  }

  /// Aircraft of this rank.
  int FlownHere() const { return config.ppo.num_aircraft / ranks.count(); }
  PpoConfig OwnRollout() const {
    PpoConfig own = config.ppo;
    own.num_aircraft = FlownHere();
    return own;
  }

  /// On the learner's backend, whatever computed it before.
  std::shared_ptr<const Policy> LowLevelPolicy() const {
    if (config.low_level == nullptr) return nullptr;
    return config.low_level->OnBackend(config.learner.backend);
  }

  void BeginAverage() {
    if (config.ppo.average_iterations > 0) mean_actor = networks.actor.optimiser.ParameterVector();
  }

  int StateSize() const { return networks.actor.layout().shape().state_size(); }

  std::uint64_t env_steps() const {
    return policy_steps * config.ppo.num_aircraft * config.env.action_repeat;
  }

  LearningRates CurrentLearningRates() const {
    const double done = config.total_steps == 0
                            ? 0
                            : std::min(1.0, static_cast<double>(env_steps()) /
                                                static_cast<double>(config.total_steps));
    const double largest = LargestLearningRate(config.ppo, done);
    const double actor =
        config.ppo.target_kl > 0 ? std::min(adapted_learning_rate, largest) : largest;
    return LearningRatesBeside(actor, config.ppo, done);
  }

  /// What has grown from 0 to 1 over `ramp` of the budget; 1 without a ramp.
  double Grown(double ramp) const {
    const double ramp_steps = ramp * static_cast<double>(config.total_steps);
    return ramp_steps > 0 ? std::min(1.0, static_cast<double>(env_steps()) / ramp_steps) : 1;
  }
  /// What handling costs, as a share of its full weight.
  double HandlingWeight() const { return Grown(config.ppo.handling_ramp); }
  /// How far the time limit of targets has grown; without a ramp it never does.
  double TimeLimitShare() const {
    return config.ppo.time_limit_ramp > 0 ? Grown(config.ppo.time_limit_ramp) : 0;
  }

  /// Its aircraft are those of this rank.
  TrainingState State() const {
    TrainingState state;
    const AdamOptimiser &actor = networks.actor.optimiser, &critic = networks.critic.optimiser;
    state.actor = actor.ParameterVector();
    state.critic = critic.ParameterVector();
    state.mean_actor = mean_actor;
    state.actor_adam = actor.state();
    state.critic_adam = critic.state();
    state.popart = popart;
    state.adapted_learning_rate = adapted_learning_rate;
    state.recurrent = recurrent;
    state.env = env.Snapshot();
    state.iteration = iteration;
    state.policy_steps = policy_steps;
    state.best_success_rate = best_success_rate;
    return state;
  }

  void SetState(const TrainingState& state) {
    // Sizes are right, LoadCheckpoint has seen to it, but for the environment's, which it asks
    // about itself: first, so that nothing has moved if it throws.
    env.Restore(state.env);
    networks.actor.optimiser.SetParameters(state.actor);
    networks.critic.optimiser.SetParameters(state.critic);
    mean_actor = state.mean_actor;
    networks.actor.optimiser.Restore(state.actor_adam);
    networks.critic.optimiser.Restore(state.critic_adam);
    popart = state.popart;
    adapted_learning_rate = state.adapted_learning_rate;
    recurrent = state.recurrent;
    iteration = state.iteration;
    policy_steps = state.policy_steps;
    best_success_rate = state.best_success_rate;
  }

  /// The whole training's, on rank 0.
  TrainingState GatheredState() const {
    return DoForOthers(ranks, [this] {
      TrainingState state = State();
      GatherAtRankZero(ranks, state.recurrent.actor);
      GatherAtRankZero(ranks, state.recurrent.critic);
      GatherAtRankZero(ranks, state.recurrent.not_done);
      GatherAtRankZero(ranks, state.env);
      return state;
    });
  }

  /// Of a whole training's state what is this rank's.
  TrainingState OwnShare(TrainingState state) const {
    const auto take = [this](auto& values) {
      const auto size = static_cast<std::int64_t>(values.size());
      const auto begin = values.begin();
      values = {begin + ShareBegin(size, ranks.rank(), ranks),
                begin + ShareBegin(size, ranks.rank() + 1, ranks)};
    };
    take(state.recurrent.actor);
    take(state.recurrent.critic);
    take(state.recurrent.not_done);
    take(state.env);
    return state;
  }

  /// Whether some rank's pool was asked to stop. Throws Error on all ranks if their parameters are
  /// not the same.
  bool AgreeOnEnd() {
    if (ranks.count() == 1) return pool.stopping();
    FnvHash hash;
    for (const TrainedNetwork* const network : {&networks.actor, &networks.critic}) {
      const AdamOptimiser& optimiser = network->optimiser;
      hash.Add(optimiser.parameters(), static_cast<std::size_t>(optimiser.size()) * sizeof(float));
    }
    if (UnionOverRanks(ranks, pool.stopping()) != 0) return true;
    fails_alike = true;
    RequireSameOnRanks(ranks, "the hash of their parameters after an iteration", hash.Hex());
    return false;
  }

  /// What is evaluated and kept: the actor, or its mean.
  RecurrentPolicy CurrentPolicy() const {
    const TrainedNetwork& actor = networks.actor;
    return RecurrentPolicy(
        PolicyInTraining(config, actor.layout().shape(),
                         mean_actor.empty() ? actor.optimiser.ParameterVector() : mean_actor),
        config.learner.backend);
  }

  /// Returns the control steps flown.
  std::uint64_t CollectExperience(IterationReport& report) {
    const auto start = std::chrono::steady_clock::now();
    networks.actor.TakeParameters();
    networks.critic.TakeParameters();
    env.SetHandlingWeight(HandlingWeight());
    env.SetConditionShare(Grown(config.ppo.condition_ramp));
    env.SetTimeLimitShare(TimeLimitShare());
    RolloutSettings settings;
    settings.seed = config.seed;
    settings.first_policy_step = policy_steps;
    settings.gamma = config.ppo.gamma;
    settings.gae_lambda = config.ppo.gae_lambda;
    settings.tanh_mean = config.network.tanh_mean;
    settings.held_noise = {config.ppo.held_noise_share, config.ppo.held_noise_steps,
                           config.ppo.held_noise_actions};
    settings.value_scale = popart.scale();
    EpisodeStatistics episodes =
        CollectRollout(env, *networks.actor.network, *networks.critic.network, networks.LogStd(),
                       settings, pool, recurrent, rollout);
    const double simulator_seconds = episodes.simulator_seconds;
    stopped = SumOverRanksOrGiveUp(ranks, pool.stopping(), episodes);
    if (!stopped) CheckRewards();
    policy_steps += config.ppo.rollout_steps;
    const auto count = static_cast<double>(episodes.episodes);
    report.episodes = episodes.episodes;
    report.terminations = episodes.terminations;
    report.non_finite = episodes.non_finite;
    report.return_mean = episodes.return_sum / count;  // 0 / 0 says that there are none
    const Termination success =
        config.env.mission.enabled() ? Termination::kTimeLimit : Termination::kTargetReached;
    report.success_rate = episodes.terminations[static_cast<int>(success)] / count;
    value_means = ValueMeans(rollout, ranks);
    report.explained_variance = ExplainedVariance(value_means);
    report.rollout_seconds = SecondsSince(start);
    report.simulator_seconds = simulator_seconds / pool.threads();
    return episodes.policy_steps * config.env.action_repeat;
  }

  void CheckRewards() {
    fails_alike = true;
    DoTogether(ranks, [&] { RequireUsableRewards(config, rollout.reward, rollout.value); });
    fails_alike = false;
  }

  /// Through the moments what is not finite in one shard would spread to all.
  void RequireFiniteTargets() {
    if (shards.total == 1 || std::isfinite(value_means[kErrorSquared])) return;
    fails_alike = true;
    int first = shards.total;
    for (int i = 0; i < rollout.aircraft && first == shards.total; ++i) {
      for (int step = 0; step < rollout.steps; ++step) {
        if (std::isfinite(rollout.target[rollout.row(step, i)])) continue;
        first = shards.first + i / rollout.shard_aircraft();
        break;
      }
    }
    throw Error("the critic's training exploded: value targets are not finite" +
                NameFirstBroken(shards, first, ranks) + "; lower " +
                CriticLearningRateKey(config.ppo) + ", or ppo.max_gradient_norm");
  }

  void Learn(IterationReport& report) {
    RequireFiniteTargets();
    const auto start = std::chrono::steady_clock::now();
    const LearningRates learning_rates = CurrentLearningRates();
    report.learning_rate = learning_rates.actor;
    if (config.ppo.popart) {
      UpdatePopArt({value_means[kTarget], value_means[kTargetSquared]}, config.ppo.popart_rate,
                   networks.critic.layout(), networks.critic.optimiser.parameters(), popart);
    }
    const UpdateReport done =
        update.Run(rollout, popart.scale(), iteration, learning_rates, HandlingWeight());
    stopped = done.stopped;
    if (stopped) return;
    report.gradient_seconds = done.gradient_seconds;
    report.wait_seconds = done.wait_seconds;
    report.policy_loss = done.losses.policy_loss;
    report.value_loss = done.losses.value_loss;
    report.entropy = done.losses.entropy;
    report.approximate_kl = done.losses.approximate_kl;
    if (config.ppo.target_kl > 0) {
      adapted_learning_rate =
          AdaptedLearningRate(config.ppo, report.learning_rate, report.approximate_kl);
    }
    if (!mean_actor.empty()) {
      MoveAverage(networks.actor.optimiser.parameters(), iteration + 1,
                  config.ppo.average_iterations, &mean_actor);
    }
    report.clip_fraction = done.losses.clip_fraction;
    report.action_change = done.losses.action_change;
    report.actor_gradient_norm = done.actor_gradient_norm;
    report.critic_gradient_norm = done.critic_gradient_norm;
    std::vector<float> log_std = networks.LogStd();
    if (networks.actor.idle_pedals) {  // what is not explored
      log_std.pop_back();
      report.entropy -= IdlePedals::Entropy();
    }
    for (const float value : log_std) report.log_std_mean += value / log_std.size();
    report.update_seconds = SecondsSince(start);
  }

  /// The same episodes each time, each rank its share, and others than an evaluation with the run's
  /// own seed flies.
  EvaluationResult Evaluation() {
    EvaluationOptions options;
    options.episodes = config.evaluation.episodes;
    options.seed = ~config.seed;
    const Agent agent = Agent::MeanOf(CurrentPolicy());
    fails_alike = true;
    const FlownEpisodes flown = FlyEpisodesOnRanks(agent, config.env, options, pool, ranks);
    fails_alike = false;
    return Summarise(flown.episodes, config.env.control_interval_s);
  }

  void EvaluateIfDue(IterationReport& report) {
    const PeriodicEvaluationConfig& evaluation = config.evaluation;
    if (evaluation.interval_iterations <= 0) return;
    if (iteration % evaluation.interval_iterations != 0 && env_steps() < config.total_steps) return;
    const auto start = std::chrono::steady_clock::now();
    const EvaluationResult result = Evaluation();
    report.evaluation_success_rate = result.success_rate;
    report.evaluation_hold_within = result.hold_within_mean;
    report.best = result.success_rate >= best_success_rate;
    if (report.best) best_success_rate = result.success_rate;
    report.evaluation_seconds = SecondsSince(start);
  }

  TrainConfig config;
  WorkerPool& pool;
  Ranks& ranks;
  ShardRange shards;
  VecEnv env;
  ActorCritic networks;
  Rollout rollout;
  Sums<kNumValueSums> value_means{};  ///< of the rollout
  RecurrentState recurrent;
  PpoUpdate update;
  PopArt popart;
  double adapted_learning_rate;
  std::vector<float> mean_actor;  ///< empty without ppo.average_iterations
  std::uint64_t iteration = 0;
  std::uint64_t policy_steps = 0;
  bool stopped = false;           ///< some rank's pool was asked to stop, as all ranks have learned
  bool fails_alike = false;       ///< what is thrown now is thrown on all ranks
  double best_success_rate = -1;  ///< of the evaluations so far
};

Trainer::Trainer(const TrainConfig& config, WorkerPool& pool, Ranks& ranks)
    : impl_(std::make_unique<Impl>(config, pool, ranks)) {}
Trainer::~Trainer() = default;

const TrainConfig& Trainer::config() const { return impl_->config; }
std::uint64_t Trainer::env_steps() const { return impl_->env_steps(); }
std::uint64_t Trainer::iteration() const { return impl_->iteration; }
bool Trainer::finished() const { return impl_->env_steps() >= impl_->config.total_steps; }

const BackendChoice& Trainer::backend() const { return impl_->networks.backend; }

IterationReport Trainer::Iterate() {
  Impl& impl = *impl_;
  const TrainingState before = DoForOthers(impl.ranks, [&] { return impl.State(); });
  impl.fails_alike = false;
  bool learns = false;
  try {
    IterationReport report;
    const std::uint64_t flown = impl.CollectExperience(report);
    learns = !impl.stopped;
    if (learns) impl.Learn(report);
    report.iteration = ++impl.iteration;
    report.env_steps = impl.env_steps();
    if (!impl.stopped) impl.EvaluateIfDue(report);
    if (!impl.stopped) impl.stopped = impl.AgreeOnEnd();
    if (!impl.stopped) return report;
    impl.SetState(before);
    IterationReport dropped;
    dropped.dropped = true;
    dropped.dropped_steps = flown;
    return dropped;
  } catch (const std::exception& error) {
    const bool exploded = learns && impl.update.exploded();
    const bool alike = impl.fails_alike || exploded || impl.ranks.count() == 1;
    if (!alike) impl.ranks.Abort(ReasonOf(error));
    impl.SetState(before);
    throw;
  }
}

bool Trainer::StartFrom(const std::string& path) {
  StartingNetworks networks = LoadNetworks(path, impl_->config, impl_->networks.actor.layout(),
                                           impl_->networks.critic.layout());
  SetPedals(impl_->config, impl_->networks.actor.layout(), networks.actor.data());
  impl_->networks.actor.optimiser.SetParameters(networks.actor);
  impl_->BeginAverage();
  if (networks.critic.empty()) return false;
  impl_->networks.critic.optimiser.SetParameters(networks.critic);
  impl_->popart = networks.popart;
  return true;
}

RecurrentPolicy Trainer::policy() const { return impl_->CurrentPolicy(); }

void Trainer::Save(const std::string& path, const std::string& records) const {
  const TrainingState state = impl_->GatheredState();
  if (impl_->ranks.rank() != 0) return;
  TensorFile file = StoreCheckpoint(impl_->config, impl_->networks.actor.layout(), state);
  if (!records.empty()) file.metadata[kRecordsKey] = records;
  file.Write(path);
}

CheckpointOrigin Trainer::Restore(const std::string& path) {
  const TensorFile file = TensorFile::Read(path);
  impl_->SetState(impl_->OwnShare(LoadCheckpoint(
      file, path, impl_->config, impl_->networks.actor.layout(), impl_->networks.critic.layout())));
  const auto records = file.metadata.find(kRecordsKey);
  return {file.metadata.at(kSimdTargetKey), records == file.metadata.end() ? "" : records->second};
}

std::uint64_t Trainer::Signature() const { return Hash(impl_->GatheredState()); }

}  // namespace skein
