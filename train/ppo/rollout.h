// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/worker_pool.h"
#include "envs/tasks/termination.h"
#include "envs/vec_env.h"
#include "train/network/recurrent_network.h"
#include "train/ppo/action_noise.h"
#include "train/ppo/ppo_config.h"
#include "train/ppo/shards.h"

namespace skein {

/// Numbers that the critic sees beside the actor's observation (PpoConfig::privileged_critic).
int PrivilegedSize(const PpoConfig& config, const VecEnv& env);

/// What PPO learns from: one row per policy step, one column per aircraft; [step][aircraft].
/// `state_size` is that of both networks, NetworkShape::state_size; `privileged_size` is
/// PrivilegedSize.
struct Rollout {
  /// Throws Error where Validate(config) does.
  Rollout(const PpoConfig& config, int observation_size, int action_size, int state_size,
          int privileged_size = 0, const ShardRange& shards = {});

  std::int64_t samples() const { return static_cast<std::int64_t>(steps) * aircraft; }
  /// Of all ranks together.
  std::int64_t all_samples() const { return samples() * (shards.total / shards.count); }
  int chunks() const { return steps / chunk_length; }  ///< per aircraft
  int shard_aircraft() const { return aircraft / shards.count; }
  std::int64_t row(int step, int index) const {
    return static_cast<std::int64_t>(step) * aircraft + index;
  }

  int critic_observation_size() const { return observation_size + privileged_size; }
  /// [steps][aircraft][critic_observation_size]
  const std::vector<float>& critic_observation() const {
    return privileged_size > 0 ? joined_observation : observation;
  }

  int steps, aircraft, chunk_length, observation_size, action_size, state_size, privileged_size;
  ShardRange shards;
  std::vector<float> observation;  ///< [steps][aircraft][observation_size]
  /// [steps][aircraft][critic_observation_size]: each observation and what is privileged behind it;
  /// empty if nothing is.
  std::vector<float> joined_observation;
  std::vector<float> action;  ///< [steps][aircraft][action_size], before clipping
  std::vector<float> log_prob, value;
  std::vector<float> reward;       ///< with the bootstrap of truncated episodes
  std::vector<float> not_done;     ///< 0 where an episode begins with this step, else 1
  std::vector<std::uint8_t> done;  ///< 1 where an episode ended with this step
  /// Of the episode that ended with this step, if EpisodeStatistics counts it; else 0.
  std::vector<float> episode_return;
  std::vector<float> bootstrap;          ///< [aircraft]: value of what follows the last step
  std::vector<float> advantage, target;  ///< target: advantage + value
  std::vector<float> actor_state, critic_state;  ///< [chunks][aircraft][state_size] at chunk starts
};

/// Sums over all samples that are here: `add(row, sums)` adds what a row has. Shard by shard, each
/// step by step, and over shards by the tree.
template <std::size_t kCount, typename Add>
Sums<kCount> SumSamples(const Rollout& rollout, const Add& add) {
  std::vector<Sums<kCount>> of_shards(static_cast<std::size_t>(rollout.shards.count));
  for (std::size_t shard = 0; shard < of_shards.size(); ++shard) {
    Sums<kCount>& sums = of_shards[shard] = {};
    const int begin = static_cast<int>(shard) * rollout.shard_aircraft();
    for (int step = 0; step < rollout.steps; ++step) {
      for (int i = begin; i < begin + rollout.shard_aircraft(); ++i)
        add(rollout.row(step, i), sums);
    }
  }
  return SumByTree(of_shards);
}

/// Where the recurrent networks stand between rollouts.
struct RecurrentState {
  RecurrentState(int aircraft, int state_size);

  std::vector<float> actor, critic;  ///< [aircraft][state_size]
  std::vector<float> not_done;       ///< [aircraft]: 0 if an episode begins with the next step
};

/// What was flown in a rollout, and the episodes that ended in it. Left out are first episodes that
/// began with a staggered clock (EnvConfig::stagger_clocks): the time limit cuts them short, and
/// their returns say nothing of whole ones. Non-finite ends are counted of all.
struct EpisodeStatistics {
  /// By all aircraft together; all of the rollout's unless stopped.
  std::uint64_t policy_steps = 0;
  std::uint64_t episodes = 0;
  double return_sum = 0;
  std::array<int, kNumTerminations> terminations{};
  int non_finite = 0;
  double simulator_seconds = 0;  ///< that threads spent in the environment; no two runs' are equal

  EpisodeStatistics& operator+=(const EpisodeStatistics& other);
};

/// The critic's output v stands for the value mean + std v (PopArt; 0 and 1 without).
struct ValueScale {
  double mean = 0, std = 1;
};

struct RolloutSettings {
  std::uint64_t seed = 0;
  /// Number of the rollout's first policy step since training began.
  std::uint64_t first_policy_step = 0;
  double gamma = 0.99, gae_lambda = 0.95;
  bool tanh_mean = true;
  HeldNoise held_noise;
  ValueScale value_scale;
};

/// Flies `rollout.steps` policy steps with every aircraft and fills `rollout`, advantages included.
/// A task per tile of the environment flies its whole rollout without waiting for others. If the
/// pool is stopping, tiles fly no further policy step and `rollout` is incomplete.
EpisodeStatistics CollectRollout(VecEnv& env, const RecurrentNetwork& actor,
                                 const RecurrentNetwork& critic, const std::vector<float>& log_std,
                                 const RolloutSettings& settings, WorkerPool& pool,
                                 RecurrentState& state, Rollout& rollout);

/// Generalised advantage estimation (Schulman et al. 2016, equation 16) and value targets of the
/// aircraft [begin, end): delta = r + gamma V' - V, A = delta + gamma lambda A', where V' and A'
/// are zero past the end of an episode.
void ComputeAdvantages(int begin, int end, double gamma, double lambda, Rollout& rollout);

}  // namespace skein
