// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/rollout.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "train/network/ppo_loss.h"

namespace skein {
namespace {

/// Memory of one worker for one tile.
struct TileScratch {
  NetworkWorkspace workspace;
  std::vector<float> noise, mean, episode_return, final_observation, privileged, joined,
      truncation_value;
  std::vector<std::uint8_t> termination;
  std::vector<std::int32_t> episode_steps, first_clock;
  ActionNoiseScratch action_noise;

  void Resize(std::size_t count, const Rollout& rollout) {
    noise.resize(count * rollout.action_size);
    mean.resize(count * rollout.action_size);
    final_observation.resize(count * rollout.observation_size);
    privileged.resize(count * rollout.privileged_size);
    joined.resize(count * rollout.critic_observation_size());
    truncation_value.resize(count);
    episode_return.resize(count);
    termination.resize(count);
    episode_steps.resize(count);
    first_clock.resize(count);
  }
};

/// One tile's flight through a rollout.
class TileRollout {
 public:
  TileRollout(VecEnv& env, int tile, const RecurrentNetwork& actor, const RecurrentNetwork& critic,
              const std::vector<float>& log_std, const RolloutSettings& settings,
              const WorkerPool& pool, TileScratch& scratch, RecurrentState& state, Rollout& rollout)
      : env_(env),
        tile_(tile),
        begin_(env.tile_begin(tile)),
        count_(env.tile_count(tile)),
        actor_(actor),
        critic_(critic),
        log_std_(log_std),
        settings_(settings),
        pool_(pool),
        scratch_(scratch),
        rollout_(rollout),
        actor_state_(state.actor.data() + static_cast<std::int64_t>(begin_) * rollout.state_size),
        critic_state_(state.critic.data() + static_cast<std::int64_t>(begin_) * rollout.state_size),
        not_done_(state.not_done.data() + begin_) {
    scratch.Resize(count_, rollout);
  }

  EpisodeStatistics Fly() {
    for (int step = 0; step < rollout_.steps; ++step) {
      if (pool_.stopping()) return statistics_;
      StoreChunkStart(step);
      ChooseActions(step);
      Step(step);
      statistics_.policy_steps += count_;
    }
    env_.Observe(tile_, scratch_.final_observation.data());
    ObservePrivileged();
    EvaluateCritic(CriticObservation(scratch_.final_observation.data(), scratch_.joined.data()),
                   critic_state_, not_done_, rollout_.bootstrap.data() + begin_);
    ComputeAdvantages(begin_, begin_ + count_, settings_.gamma, settings_.gae_lambda, rollout_);
    return statistics_;
  }

 private:
  /// Runs a part of the simulator on the clock.
  template <typename Part>
  void Simulate(const Part& part) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    part();
    statistics_.simulator_seconds += std::chrono::duration<double>(Clock::now() - start).count();
  }

  std::int64_t Row(int step) const { return rollout_.row(step, begin_); }
  float* Observation(int step) const {
    return rollout_.observation.data() + Row(step) * rollout_.observation_size;
  }

  /// Where the critic's observations of a step are kept; null if they are the actor's.
  float* JoinedObservation(int step) const {
    if (rollout_.privileged_size == 0) return nullptr;
    return rollout_.joined_observation.data() + Row(step) * rollout_.critic_observation_size();
  }

  /// Leaves what is privileged now in the scratch memory.
  void ObservePrivileged() {
    if (rollout_.privileged_size > 0) env_.ObservePrivileged(tile_, scratch_.privileged.data());
  }

  /// What the critic sees: `observation`, or it and what is privileged behind it, in `joined`.
  const float* CriticObservation(const float* observation, float* joined) const {
    const int own = rollout_.observation_size, privileged = rollout_.privileged_size;
    if (privileged == 0) return observation;
    for (std::int64_t i = 0; i < count_; ++i) {
      float* const row = joined + i * (own + privileged);
      std::copy_n(observation + i * own, own, row);
      std::copy_n(scratch_.privileged.data() + i * privileged, privileged, row + own);
    }
    return joined;
  }

  void StoreChunkStart(int step) {
    if (step % rollout_.chunk_length != 0) return;
    const std::int64_t values = static_cast<std::int64_t>(count_) * rollout_.state_size;
    const std::int64_t offset =
        rollout_.row(step / rollout_.chunk_length, begin_) * rollout_.state_size;
    std::copy_n(actor_state_, values, rollout_.actor_state.begin() + offset);
    std::copy_n(critic_state_, values, rollout_.critic_state.begin() + offset);
  }

  /// Values of `observation` for the recurrent state; the state after it is left in the workspace.
  void EvaluateCritic(const float* observation, const float* state, const float* not_done,
                      float* value) {
    critic_.Forward({1, count_, observation, state, not_done}, scratch_.workspace);
    const ValueScale& scale = settings_.value_scale;
    for (int i = 0; i < count_; ++i) {
      value[i] = static_cast<float>(scale.mean + scale.std * scratch_.workspace.output()[i]);
    }
  }

  void ChooseActions(int step) {
    const std::int64_t row = Row(step),
                       states = static_cast<std::int64_t>(count_) * rollout_.state_size;
    const int size = rollout_.action_size;
    float* const observation = Observation(step);
    Simulate([&] {
      env_.Observe(tile_, observation);
      ObservePrivileged();
    });
    std::copy_n(not_done_, count_, rollout_.not_done.begin() + row);

    EvaluateCritic(CriticObservation(observation, JoinedObservation(step)), critic_state_,
                   not_done_, rollout_.value.data() + row);
    std::copy_n(scratch_.workspace.final_state(), states, critic_state_);
    actor_.Forward({1, count_, observation, actor_state_, not_done_}, scratch_.workspace);
    std::copy_n(scratch_.workspace.final_state(), states, actor_state_);
    GaussianMean(static_cast<std::int64_t>(count_) * size, settings_.tanh_mean,
                 scratch_.workspace.output(), scratch_.mean.data());

    FillActionNoise(
        {settings_.seed, static_cast<std::uint32_t>(env_.first_aircraft() + begin_),
         settings_.first_policy_step + static_cast<std::uint64_t>(step), settings_.held_noise},
        count_, size, scratch_.action_noise, scratch_.noise.data());
    float* const action = rollout_.action.data() + row * size;
    for (int i = 0; i < count_; ++i) {
      for (int j = 0; j < size; ++j) {
        action[i * size + j] =
            scratch_.mean[i * size + j] + std::exp(log_std_[j]) * scratch_.noise[i * size + j];
      }
    }
    LogProbability(count_, size, scratch_.mean.data(), log_std_.data(), action,
                   rollout_.log_prob.data() + row);
  }

  void Step(int step) {
    const std::int64_t row = Row(step);
    float* const reward = rollout_.reward.data() + row;
    StepOutput output;
    output.reward = reward;
    output.termination = scratch_.termination.data();
    output.episode_return = scratch_.episode_return.data();
    output.episode_steps = scratch_.episode_steps.data();
    const bool truncates = env_.config().episode().truncate_at_time_limit;
    output.first_clock = scratch_.first_clock.data();
    if (truncates) output.final_observation = scratch_.final_observation.data();
    if (rollout_.privileged_size > 0) output.final_privileged = scratch_.privileged.data();
    Simulate(
        [&] { env_.Step(tile_, rollout_.action.data() + row * rollout_.action_size, output); });
    bool truncated = false;
    for (int i = 0; i < count_; ++i) {
      const auto termination = static_cast<Termination>(scratch_.termination[i]);
      const bool done = termination != Termination::kNone;
      rollout_.done[row + i] = done;
      rollout_.episode_return[row + i] = 0;
      truncated |= truncates && termination == Termination::kTimeLimit;
      if (!done) continue;
      if (termination == Termination::kNonFinite) ++statistics_.non_finite;
      if (scratch_.first_clock[i] > 0) continue;
      ++statistics_.episodes;
      ++statistics_.terminations[scratch_.termination[i]];
      rollout_.episode_return[row + i] = scratch_.episode_return[i];
    }
    if (truncated) AddTruncatedValues(reward);
    for (int i = 0; i < count_; ++i) not_done_[i] = rollout_.done[row + i] ? 0.0f : 1.0f;
  }

  /// An episode that the time limit truncates would have continued: its last reward takes the
  /// value of its last observation.
  void AddTruncatedValues(float* reward) {
    // Rows of other aircraft hold nothing of this step; they are computed and discarded.
    const auto clear = [](std::vector<float>& rows, std::int64_t i, int size) {
      std::fill_n(rows.begin() + i * size, size, 0.0f);
    };
    for (int i = 0; i < count_; ++i) {
      if (scratch_.termination[i] != static_cast<std::uint8_t>(Termination::kTimeLimit)) {
        clear(scratch_.final_observation, i, rollout_.observation_size);
        clear(scratch_.privileged, i, rollout_.privileged_size);
      }
    }
    // In this evaluation the episode has not ended, whatever begins with the next step.
    const std::vector<float> not_done(count_, 1.0f);
    EvaluateCritic(CriticObservation(scratch_.final_observation.data(), scratch_.joined.data()),
                   critic_state_, not_done.data(), scratch_.truncation_value.data());
    for (int i = 0; i < count_; ++i) {
      if (scratch_.termination[i] == static_cast<std::uint8_t>(Termination::kTimeLimit)) {
        reward[i] += static_cast<float>(settings_.gamma) * scratch_.truncation_value[i];
      }
    }
  }

  VecEnv& env_;
  int tile_, begin_, count_;
  const RecurrentNetwork& actor_;
  const RecurrentNetwork& critic_;
  const std::vector<float>& log_std_;
  const RolloutSettings& settings_;
  const WorkerPool& pool_;
  TileScratch& scratch_;
  Rollout& rollout_;
  float* actor_state_;
  float* critic_state_;
  float* not_done_;
  EpisodeStatistics statistics_;
};

}  // namespace

int PrivilegedSize(const PpoConfig& config, const VecEnv& env) {
  return config.privileged_critic ? env.privileged_size() : 0;
}

Rollout::Rollout(const PpoConfig& config, int observations, int actions, int states, int privileged,
                 const ShardRange& range)
    : steps(config.rollout_steps),
      aircraft(config.num_aircraft),
      chunk_length(config.chunk_length),
      observation_size(observations),
      action_size(actions),
      state_size(states),
      privileged_size(privileged),
      shards(range) {
  Validate(config);
  observation.resize(samples() * observation_size);
  if (privileged_size > 0) joined_observation.resize(samples() * critic_observation_size());
  action.resize(samples() * action_size);
  for (auto* const column :
       {&log_prob, &value, &reward, &not_done, &advantage, &target, &episode_return}) {
    column->resize(samples());
  }
  done.resize(samples());
  bootstrap.resize(aircraft);
  const std::int64_t stored = static_cast<std::int64_t>(chunks()) * aircraft * state_size;
  actor_state.resize(stored);
  critic_state.resize(stored);
}

RecurrentState::RecurrentState(int aircraft, int state_size)
    : actor(static_cast<std::size_t>(aircraft) * state_size, 0.0f),
      critic(static_cast<std::size_t>(aircraft) * state_size, 0.0f),
      not_done(aircraft, 0.0f) {}

EpisodeStatistics& EpisodeStatistics::operator+=(const EpisodeStatistics& other) {
  policy_steps += other.policy_steps;
  episodes += other.episodes;
  return_sum += other.return_sum;
  non_finite += other.non_finite;
  simulator_seconds += other.simulator_seconds;
  for (int i = 0; i < kNumTerminations; ++i) terminations[i] += other.terminations[i];
  return *this;
}

namespace {

/// Of the aircraft [begin, end).
double SumReturns(int begin, int end, const Rollout& rollout) {
  double sum = 0;
  for (int step = 0; step < rollout.steps; ++step) {
    for (int i = begin; i < end; ++i) sum += rollout.episode_return[rollout.row(step, i)];
  }
  return sum;
}

/// One shard is summed by tiles, as ever: which tile holds which aircraft is then part of the
/// configuration, which it is not where a shard may begin within a tile.
double SumReturns(const VecEnv& env, const Rollout& rollout) {
  if (rollout.shards.total > 1) {
    return SumSamples<1>(rollout, [&](std::int64_t row, Sums<1>& sums) {
      sums[0] += rollout.episode_return[row];
    })[0];
  }
  double sum = 0;
  for (int tile = 0; tile < env.num_tiles(); ++tile) {
    const int begin = env.tile_begin(tile);
    sum += SumReturns(begin, begin + env.tile_count(tile), rollout);
  }
  return sum;
}

}  // namespace

EpisodeStatistics CollectRollout(VecEnv& env, const RecurrentNetwork& actor,
                                 const RecurrentNetwork& critic, const std::vector<float>& log_std,
                                 const RolloutSettings& settings, WorkerPool& pool,
                                 RecurrentState& state, Rollout& rollout) {
  std::vector<TileScratch> scratch(pool.threads());
  std::vector<EpisodeStatistics> statistics(env.num_tiles());
  pool.ForEach(env.num_tiles(), [&](int tile, int worker) {
    statistics[tile] = TileRollout(env, tile, actor, critic, log_std, settings, pool,
                                   scratch[worker], state, rollout)
                           .Fly();
  });
  EpisodeStatistics total;
  for (const EpisodeStatistics& part : statistics) total += part;
  total.return_sum = SumReturns(env, rollout);
  return total;
}

void ComputeAdvantages(int begin, int end, double gamma, double lambda, Rollout& rollout) {
  const auto discount = static_cast<float>(gamma);
  const auto decay = static_cast<float>(gamma * lambda);
  for (int step = rollout.steps - 1; step >= 0; --step) {
    const bool last = step == rollout.steps - 1;
    for (int i = begin; i < end; ++i) {
      const std::int64_t row = rollout.row(step, i), next = row + rollout.aircraft;
      const float continues = rollout.done[row] ? 0.0f : 1.0f;
      const float next_value = last ? rollout.bootstrap[i] : rollout.value[next];
      const float next_advantage = last ? 0.0f : rollout.advantage[next];
      const float delta =
          rollout.reward[row] + discount * continues * next_value - rollout.value[row];
      rollout.advantage[row] = delta + decay * continues * next_advantage;
      rollout.target[row] = rollout.advantage[row] + rollout.value[row];
    }
  }
}

}  // namespace skein
