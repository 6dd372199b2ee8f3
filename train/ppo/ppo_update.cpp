// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/ppo_update.h"

#include <algorithm>
#include <array>
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

  void Resize(const Rollout& rollout, std::int64_t rows, int chunks) {
    observation.resize(rows * rollout.observation_size);
    state.resize(static_cast<std::int64_t>(chunks) * rollout.state_size);
    action.resize(rows * rollout.action_size);
    for (auto* const column : {&not_done, &log_prob, &advantage, &target, &old_value}) {
      column->resize(rows);
    }
  }
};

PpoUpdate::PpoUpdate(const TrainConfig& config, const BackendChoice& backend,
                     const NetworkLayout& actor, const NetworkLayout& critic, WorkerPool& pool)
    : config_(config.ppo),
      seed_(config.seed),
      tanh_mean_(config.network.tanh_mean),
      tile_chunks_(std::max(1, config.learner.tile_samples / config.ppo.chunk_length)),
      pool_(pool) {
  actor_.network = MakeNetwork(backend.backend, actor, ActorPrecision(backend.precision));
  critic_.network = MakeNetwork(backend.backend, critic, CriticPrecision(backend.precision));
  for (int i = 0; i < pool.threads(); ++i) gathered_.push_back(std::make_shared<Gathered>());
}

PpoUpdate::Advantages PpoUpdate::AdvantageScale(const Rollout& rollout) const {
  if (!config_.normalise_advantages) return {};
  const auto count = static_cast<double>(rollout.samples());
  double sum = 0, squares = 0;
  for (const float advantage : rollout.advantage) sum += advantage;
  const double mean = sum / count;
  for (const float advantage : rollout.advantage)
    squares += (advantage - mean) * (advantage - mean);
  return {mean, 1 / (std::sqrt(squares / count) + kAdvantageEpsilon)};
}

void PpoUpdate::RunShard(Side& side, const Rollout& rollout, const ValueScale& scale,
                         const Advantages& advantages, const std::int64_t* chunks, int count,
                         const LossSettings& settings, int shard, int worker) {
  AlignedVector<float>& accumulator = side.accumulators[shard];
  accumulator.assign(side.network->accumulator_size(), 0.0f);
  side.losses[shard] = {};
  const bool is_actor = &side == &actor_;
  const std::vector<float>& states = is_actor ? rollout.actor_state : rollout.critic_state;
  Gathered& own = *gathered_[worker];
  for (int first = 0; first < count && !pool_.stopping(); first += tile_chunks_) {
    const int batch = std::min(tile_chunks_, count - first);
    const std::int64_t rows = static_cast<std::int64_t>(batch) * rollout.chunk_length;
    own.Resize(rollout, rows, batch);
    for (int i = 0; i < batch; ++i) {
      const std::int64_t chunk = chunks[first + i];
      const auto aircraft = static_cast<int>(chunk % rollout.aircraft);
      const auto chunk_step = static_cast<int>(chunk / rollout.aircraft) * rollout.chunk_length;
      std::copy_n(states.begin() + chunk * rollout.state_size, rollout.state_size,
                  own.state.begin() + static_cast<std::int64_t>(i) * rollout.state_size);
      for (int step = 0; step < rollout.chunk_length; ++step) {
        const std::int64_t from = rollout.row(chunk_step + step, aircraft);
        const std::int64_t to = static_cast<std::int64_t>(step) * batch + i;
        std::copy_n(rollout.observation.begin() + from * rollout.observation_size,
                    rollout.observation_size,
                    own.observation.begin() + to * rollout.observation_size);
        own.not_done[to] = rollout.not_done[from];
        if (is_actor) {
          std::copy_n(rollout.action.begin() + from * rollout.action_size, rollout.action_size,
                      own.action.begin() + to * rollout.action_size);
          own.log_prob[to] = rollout.log_prob[from];
          own.advantage[to] = static_cast<float>((rollout.advantage[from] - advantages.mean) *
                                                 advantages.inverse_std);
        } else {
          own.target[to] = static_cast<float>((rollout.target[from] - scale.mean) / scale.std);
          own.old_value[to] = static_cast<float>((rollout.value[from] - scale.mean) / scale.std);
        }
      }
    }
    SampleTile tile;
    tile.sequence = {rollout.chunk_length, batch, own.observation.data(), own.state.data(),
                     own.not_done.data()};
    tile.actor = {own.action.data(), own.log_prob.data(), own.advantage.data()};
    tile.target = own.target.data();
    tile.old_value = own.old_value.data();
    side.losses[shard] +=
        side.network->AccumulateGradient(tile, settings, own.workspace, accumulator.data());
  }
}

LossSums PpoUpdate::Minibatch(const Rollout& rollout, const ValueScale& scale,
                              const Advantages& advantages, const std::int64_t* chunks, int count,
                              double learning_rate, AdamOptimiser& actor, AdamOptimiser& critic) {
  LossSettings settings;
  settings.clip = config_.clip;
  settings.entropy_coefficient = config_.entropy_coefficient;
  settings.value_coefficient = config_.value_coefficient;
  settings.clip_value_loss = config_.clip_value_loss;
  settings.tanh_mean = tanh_mean_;
  settings.sample_weight = 1.0 / (static_cast<double>(count) * rollout.chunk_length);

  const int tiles = (count + tile_chunks_ - 1) / tile_chunks_;
  const int shards = std::min(tiles, kMaxShards);
  const auto shard_begin = [&](int shard) {
    return std::min(
        count, static_cast<int>(static_cast<std::int64_t>(shard) * tiles / shards) * tile_chunks_);
  };
  const std::array<Side*, 2> sides{&actor_, &critic_};
  const std::array<AdamOptimiser*, 2> optimisers{&actor, &critic};
  for (Side* const side : sides) {
    side->accumulators.resize(shards);
    side->losses.resize(shards);
  }
  pool_.ForEach(2,
                [&](int i, int) { sides[i]->network->SetParameters(optimisers[i]->parameters()); });
  const auto start = std::chrono::steady_clock::now();
  pool_.ForEach(2 * shards, [&](int index, int worker) {
    const int shard = index / 2, begin = shard_begin(shard);
    RunShard(*sides[index % 2], rollout, scale, advantages, chunks + begin,
             shard_begin(shard + 1) - begin, settings, shard, worker);
  });
  gradient_seconds_ +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (pool_.stopping()) return {};
  for (Side* const side : sides) {
    auto& accumulators = side->accumulators;
    const auto size = static_cast<std::int64_t>(accumulators[0].size());
    const auto blocks = static_cast<int>((size + kSumBlock - 1) / kSumBlock);
    pool_.ForEach(blocks, [&](int block, int) {
      const std::int64_t begin = block * kSumBlock;
      SumShards(begin, std::min(size, begin + kSumBlock), accumulators);
    });
  }
  pool_.ForEach(2, [&](int i, int) {
    Side& side = *sides[i];
    side.network->FinishGradient(side.accumulators[0].data(), optimisers[i]->gradient());
    side.norm = ClippedStep(config_.max_gradient_norm, learning_rate, *optimisers[i]);
  });
  LossSums total;
  for (int shard = 0; shard < shards; ++shard) {
    total += actor_.losses[shard];
    total += critic_.losses[shard];
  }
  RequireSane("actor", total.policy_loss, actor_.norm);
  RequireSane("critic", total.value_loss, critic_.norm);
  return total;
}

UpdateReport PpoUpdate::Run(const Rollout& rollout, const ValueScale& scale,
                            std::uint64_t iteration, double learning_rate, AdamOptimiser& actor,
                            AdamOptimiser& critic) {
  const Advantages advantages = AdvantageScale(rollout);
  const std::int64_t chunks = static_cast<std::int64_t>(rollout.chunks()) * rollout.aircraft;
  UpdateReport report;
  gradient_seconds_ = 0;
  for (int epoch = 0; epoch < config_.epochs; ++epoch) {
    const std::vector<std::int64_t> order = ShuffledChunks(chunks, seed_, iteration, epoch);
    for (int minibatch = 0; minibatch < config_.minibatches; ++minibatch) {
      if (pool_.stopping()) return report;
      const std::int64_t begin = chunks * minibatch / config_.minibatches;
      const std::int64_t end = chunks * (minibatch + 1) / config_.minibatches;
      report.losses += Minibatch(rollout, scale, advantages, order.data() + begin,
                                 static_cast<int>(end - begin), learning_rate, actor, critic);
      report.actor_gradient_norm += actor_.norm;
      report.critic_gradient_norm += critic_.norm;
    }
  }
  const double count = static_cast<double>(config_.epochs) * config_.minibatches;
  LossSums& losses = report.losses;
  for (double* const mean :
       {&losses.policy_loss, &losses.value_loss, &losses.entropy, &losses.approximate_kl,
        &losses.clip_fraction, &report.actor_gradient_norm, &report.critic_gradient_norm}) {
    *mean /= count;
  }
  report.gradient_seconds = gradient_seconds_;
  return report;
}

}  // namespace skein
