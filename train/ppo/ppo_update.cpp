// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/ppo_update.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <string>

#include "base/error.h"
#include "simd/random.h"
#include "train/ppo/minibatch_step.h"

namespace skein {
namespace {

/// Shards of a minibatch and network at most: enough for many threads, few enough to keep their
/// gradients in memory.
constexpr int kMaxShards = 32;
constexpr double kAdvantageEpsilon = 1e-8;

/// A permutation of [0, count): Fisher and Yates, keyed by (seed, iteration, epoch).
std::vector<std::int64_t> ShuffledChunks(std::int64_t count, std::uint64_t seed,
                                         std::uint64_t iteration, int epoch) {
  std::vector<std::int64_t> chunks(count);
  std::iota(chunks.begin(), chunks.end(), std::int64_t{0});
  simd::RandomStream random({seed, static_cast<std::uint32_t>(iteration),
                             static_cast<std::uint32_t>(iteration >> 32),
                             static_cast<std::uint32_t>(epoch), simd::RandomPurpose::kShuffle});
  for (std::int64_t i = count - 1; i > 0; --i) {
    const auto other = static_cast<std::int64_t>(random.Uniform() * static_cast<double>(i + 1));
    std::swap(chunks[i], chunks[other]);
  }
  return chunks;
}

void RequireSane(const char* network, double loss, double norm) {
  if (std::isfinite(loss) && norm <= kExplodedGradientNorm) return;
  throw Error("the " + std::string(network) + "'s training exploded (loss " + std::to_string(loss) +
              ", gradient norm " + std::to_string(norm) +
              "); lower ppo.learning_rate, or ppo.max_gradient_norm");
}

}  // namespace

/// Chunks of a tile in time-major order, and what the networks need to compute them.
struct PpoUpdate::Gathered {
  NetworkWorkspace workspace;
  AlignedVector<float> observation, state, not_done, action, log_prob, advantage, target, old_value;

  /// The samples of `chunks`, for an actor or a critic; they stand until the next call.
  SampleTile Gather(const Source& source, bool for_actor, const Chunks& chunks) {
    const Rollout& rollout = source.rollout;
    const int seen = for_actor ? rollout.observation_size : rollout.critic_observation_size();
    Resize(rollout, seen, chunks.count);
    const std::vector<float>& observations =
        for_actor ? rollout.observation : rollout.critic_observation();
    const std::vector<float>& states = for_actor ? rollout.actor_state : rollout.critic_state;
    for (int i = 0; i < chunks.count; ++i) {
      const std::int64_t chunk = chunks.first[i];
      const auto aircraft = static_cast<int>(chunk % rollout.aircraft);
      const auto chunk_step = static_cast<int>(chunk / rollout.aircraft) * rollout.chunk_length;
      std::copy_n(states.begin() + chunk * rollout.state_size, rollout.state_size,
                  state.begin() + static_cast<std::int64_t>(i) * rollout.state_size);
      for (int step = 0; step < rollout.chunk_length; ++step) {
        const std::int64_t from = rollout.row(chunk_step + step, aircraft);
        const std::int64_t to = static_cast<std::int64_t>(step) * chunks.count + i;
        std::copy_n(observations.begin() + from * seen, seen, observation.begin() + to * seen);
        not_done[to] = rollout.not_done[from];
        if (for_actor) {
          TakeActorSample(source, from, to);
        } else {
          TakeCriticSample(source, from, to);
        }
      }
    }
    SampleTile tile;
    tile.sequence = {rollout.chunk_length, chunks.count, observation.data(), state.data(),
                     not_done.data()};
    tile.actor = {action.data(), log_prob.data(), advantage.data()};
    tile.target = target.data();
    tile.old_value = old_value.data();
    return tile;
  }

 private:
  void Resize(const Rollout& rollout, int observation_size, int chunks) {
    const std::int64_t rows = static_cast<std::int64_t>(chunks) * rollout.chunk_length;
    observation.resize(rows * observation_size);
    state.resize(static_cast<std::int64_t>(chunks) * rollout.state_size);
    action.resize(rows * rollout.action_size);
    for (auto* const column : {&not_done, &log_prob, &advantage, &target, &old_value}) {
      column->resize(rows);
    }
  }

  void TakeActorSample(const Source& source, std::int64_t from, std::int64_t to) {
    const Rollout& rollout = source.rollout;
    std::copy_n(rollout.action.begin() + from * rollout.action_size, rollout.action_size,
                action.begin() + to * rollout.action_size);
    log_prob[to] = rollout.log_prob[from];
    advantage[to] = static_cast<float>((rollout.advantage[from] - source.advantage_mean) *
                                       source.advantage_inverse_std);
  }

  void TakeCriticSample(const Source& source, std::int64_t from, std::int64_t to) {
    const ValueScale& scale = source.value_scale;
    target[to] = static_cast<float>((source.rollout.target[from] - scale.mean) / scale.std);
    old_value[to] = static_cast<float>((source.rollout.value[from] - scale.mean) / scale.std);
  }
};

PpoUpdate::PpoUpdate(const TrainConfig& config, ActorCritic& networks, WorkerPool& pool)
    : config_(config.ppo),
      seed_(config.seed),
      tanh_mean_(config.network.tanh_mean),
      tile_chunks_(std::max(1, config.learner.tile_samples / config.ppo.chunk_length)),
      pool_(pool),
      sides_{Side{networks.actor, {}, {}}, Side{networks.critic, {}, {}}} {
  for (int i = 0; i < pool.threads(); ++i) gathered_.push_back(std::make_shared<Gathered>());
}

PpoUpdate::Source PpoUpdate::SourceOf(const Rollout& rollout, const ValueScale& scale) const {
  if (!config_.normalise_advantages) return {rollout, scale};
  const auto count = static_cast<double>(rollout.samples());
  double sum = 0, squares = 0;
  for (const float advantage : rollout.advantage) sum += advantage;
  const double mean = sum / count;
  for (const float advantage : rollout.advantage) {
    squares += (advantage - mean) * (advantage - mean);
  }
  return {rollout, scale, mean, 1 / (std::sqrt(squares / count) + kAdvantageEpsilon)};
}

LossSettings PpoUpdate::SettingsFor(const Rollout& rollout, const Chunks& minibatch) const {
  LossSettings settings;
  settings.clip = config_.clip;
  settings.entropy_coefficient = config_.entropy_coefficient;
  settings.value_coefficient = config_.value_coefficient;
  settings.clip_value_loss = config_.clip_value_loss;
  settings.tanh_mean = tanh_mean_;
  settings.action_smoothness_coefficient = config_.action_smoothness_coefficient * handling_weight_;
  const auto chunks = static_cast<double>(minibatch.count);
  settings.sample_weight = 1 / (chunks * rollout.chunk_length);
  if (rollout.chunk_length > 1) settings.pair_weight = 1 / (chunks * (rollout.chunk_length - 1));
  return settings;
}

void PpoUpdate::AccumulateShard(Side& side, const Source& source, const Chunks& chunks,
                                const LossSettings& settings, int shard, int worker) {
  const RecurrentNetwork& network = *side.trained.network;
  AlignedVector<float>& accumulator = side.accumulators[shard];
  accumulator.assign(network.accumulator_size(), 0.0f);
  side.losses[shard] = {};
  Gathered& own = *gathered_[worker];
  for (int first = 0; first < chunks.count && !pool_.stopping(); first += tile_chunks_) {
    const Chunks batch{chunks.first + first, std::min(tile_chunks_, chunks.count - first)};
    side.losses[shard] += network.AccumulateGradient(own.Gather(source, is_actor(side), batch),
                                                     settings, own.workspace, accumulator.data());
  }
}

void PpoUpdate::AccumulateShards(const Source& source, const Chunks& minibatch) {
  const LossSettings settings = SettingsFor(source.rollout, minibatch);
  const int tiles = (minibatch.count + tile_chunks_ - 1) / tile_chunks_;
  const int shards = std::min(tiles, kMaxShards);
  const auto shard_begin = [&](int shard) {
    const auto tile = static_cast<int>(static_cast<std::int64_t>(shard) * tiles / shards);
    return std::min(minibatch.count, tile * tile_chunks_);
  };
  for (Side& side : sides_) {
    side.accumulators.resize(shards);
    side.losses.resize(shards);
  }
  pool_.ForEach(2, [&](int i, int) { sides_[i].trained.TakeParameters(); });
  const auto start = std::chrono::steady_clock::now();
  pool_.ForEach(2 * shards, [&](int index, int worker) {
    const int shard = index / 2, begin = shard_begin(shard);
    AccumulateShard(sides_[index % 2], source,
                    {minibatch.first + begin, shard_begin(shard + 1) - begin}, settings, shard,
                    worker);
  });
  gradient_seconds_ +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void PpoUpdate::SumAllShards() {
  for (Side& side : sides_) {
    const auto size = static_cast<std::int64_t>(side.accumulators[0].size());
    const auto blocks = static_cast<int>((size + kSumBlock - 1) / kSumBlock);
    pool_.ForEach(blocks, [&](int block, int) {
      const std::int64_t begin = block * kSumBlock;
      SumShards(begin, std::min(size, begin + kSumBlock), side.accumulators);
    });
  }
}

LossSums PpoUpdate::RunMinibatch(const Source& source, const Chunks& minibatch,
                                 double learning_rate) {
  AccumulateShards(source, minibatch);
  if (pool_.stopping()) return {};
  SumAllShards();
  pool_.ForEach(2, [&](int i, int) {
    Side& side = sides_[i];
    AdamOptimiser& optimiser = side.trained.optimiser;
    side.trained.network->FinishGradient(side.accumulators[0].data(), optimiser.gradient());
    side.norm = ClippedStep(config_.max_gradient_norm, learning_rate, optimiser);
  });
  const auto& [actor, critic] = sides_;
  LossSums total;
  for (std::size_t shard = 0; shard < actor.losses.size(); ++shard) {
    total += actor.losses[shard];
    total += critic.losses[shard];
  }
  RequireSane("actor", total.policy_loss, actor.norm);
  RequireSane("critic", total.value_loss, critic.norm);
  return total;
}

UpdateReport PpoUpdate::Run(const Rollout& rollout, const ValueScale& scale,
                            std::uint64_t iteration, double learning_rate, double handling_weight) {
  handling_weight_ = handling_weight;
  const Source source = SourceOf(rollout, scale);
  const std::int64_t chunks = static_cast<std::int64_t>(rollout.chunks()) * rollout.aircraft;
  UpdateReport report;
  gradient_seconds_ = 0;
  for (int epoch = 0; epoch < config_.epochs; ++epoch) {
    const std::vector<std::int64_t> order = ShuffledChunks(chunks, seed_, iteration, epoch);
    for (int minibatch = 0; minibatch < config_.minibatches; ++minibatch) {
      if (pool_.stopping()) return report;
      const std::int64_t begin = chunks * minibatch / config_.minibatches;
      const std::int64_t end = chunks * (minibatch + 1) / config_.minibatches;
      report.losses += RunMinibatch(source, {order.data() + begin, static_cast<int>(end - begin)},
                                    learning_rate);
      report.actor_gradient_norm += sides_[0].norm;
      report.critic_gradient_norm += sides_[1].norm;
    }
  }
  const double count = static_cast<double>(config_.epochs) * config_.minibatches;
  LossSums& losses = report.losses;
  for (double* const mean : {&losses.policy_loss, &losses.value_loss, &losses.entropy,
                             &losses.approximate_kl, &losses.clip_fraction, &losses.action_change,
                             &report.actor_gradient_norm, &report.critic_gradient_norm}) {
    *mean /= count;
  }
  report.gradient_seconds = gradient_seconds_;
  return report;
}

}  // namespace skein
