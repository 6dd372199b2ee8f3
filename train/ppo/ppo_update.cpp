// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/ppo_update.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "base/denormals.h"
#include "base/error.h"
#include "base/number_text.h"
#include "base/seconds_since.h"
#include "train/ppo/broken_shard.h"
#include "train/ppo/clipped_step.h"
#include "train/ppo/gradient_sums.h"
#include "train/ranks/collectives.h"

namespace skein {
namespace {

/// Accumulators of a network at most, unless there are more shards: enough for many threads, few
/// enough to keep the gradients in memory.
constexpr int kMaxAccumulators = 32;
constexpr double kAdvantageEpsilon = 1e-8;

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

PpoUpdate::PpoUpdate(const TrainConfig& config, ActorCritic& networks, WorkerPool& pool,
                     Ranks& ranks)
    : config_(config.ppo),
      seed_(config.seed),
      tanh_mean_(config.network.tanh_mean),
      tile_chunks_(std::max(1, config.learner.tile_samples / config.ppo.chunk_length)),
      pool_(pool),
      ranks_(ranks),
      sides_{Side{"actor", &LossSums::policy_loss, networks.actor},
             Side{"critic", &LossSums::value_loss, networks.critic}} {
  for (int i = 0; i < pool.threads(); ++i) gathered_.push_back(std::make_shared<Gathered>());
}

PpoUpdate::Source PpoUpdate::SourceOf(const Rollout& rollout, const ValueScale& scale) {
  if (!config_.normalise_advantages) return {rollout, scale};
  const auto count = static_cast<double>(rollout.all_samples());
  auto sum = SumSamples<1>(
      rollout, [&](std::int64_t row, Sums<1>& sums) { sums[0] += rollout.advantage[row]; });
  SumOverRanks(ranks_, sum.size(), sum.data());
  const double mean = sum[0] / count;
  auto squares = SumSamples<1>(rollout, [&](std::int64_t row, Sums<1>& sums) {
    sums[0] += (rollout.advantage[row] - mean) * (rollout.advantage[row] - mean);
  });
  SumOverRanks(ranks_, squares.size(), squares.data());
  return {rollout, scale, mean, 1 / (std::sqrt(squares[0] / count) + kAdvantageEpsilon)};
}

int PpoUpdate::Slices(int chunks, const ShardRange& shards) const {
  return std::min((chunks + tile_chunks_ - 1) / tile_chunks_,
                  std::max(1, kMaxAccumulators / shards.total));
}

PpoUpdate::Minibatch PpoUpdate::Cut(std::vector<Chunks> shards, const Rollout& rollout) const {
  const int chunks = shards[0].count;
  Minibatch minibatch;
  minibatch.shards = std::move(shards);
  minibatch.slices = Slices(chunks, rollout.shards);
  minibatch.chunks = static_cast<double>(chunks) * rollout.shards.total;
  return minibatch;
}

Chunks PpoUpdate::SliceOf(const Chunks& shard, int slice, int slices) const {
  const int tiles = (shard.count + tile_chunks_ - 1) / tile_chunks_;
  const auto begin = [&](int index) {
    const auto tile = static_cast<int>(static_cast<std::int64_t>(index) * tiles / slices);
    return std::min(shard.count, tile * tile_chunks_);
  };
  return {shard.first + begin(slice), begin(slice + 1) - begin(slice)};
}

LossSettings PpoUpdate::SettingsFor(const Minibatch& minibatch, int chunk_length) const {
  LossSettings settings;
  settings.clip = config_.clip;
  settings.entropy_coefficient = config_.entropy_coefficient;
  settings.value_coefficient = config_.value_coefficient;
  settings.clip_value_loss = config_.clip_value_loss;
  settings.tanh_mean = tanh_mean_;
  settings.action_smoothness_coefficient = config_.action_smoothness_coefficient * handling_weight_;
  settings.sample_weight = 1 / (minibatch.chunks * chunk_length);
  if (chunk_length > 1) settings.pair_weight = 1 / (minibatch.chunks * (chunk_length - 1));
  return settings;
}

void PpoUpdate::AccumulateSlice(Side& side, const Source& source, const Chunks& chunks,
                                const LossSettings& settings, int accumulator, int worker) {
  const RecurrentNetwork& network = *side.trained.network;
  AlignedVector<float>& gradient = side.accumulators[accumulator];
  gradient.assign(network.accumulator_size(), 0.0f);
  side.losses[accumulator] = {};
  Gathered& own = *gathered_[worker];
  for (int first = 0; first < chunks.count && !pool_.stopping(); first += tile_chunks_) {
    const Chunks batch{chunks.first + first, std::min(tile_chunks_, chunks.count - first)};
    side.losses[accumulator] += network.AccumulateGradient(
        own.Gather(source, is_actor(side), batch), settings, own.workspace, gradient.data());
  }
}

void PpoUpdate::ComputeGradients(const Source& source, const Minibatch& minibatch,
                                 const std::vector<Side*>& sides) {
  const LossSettings settings = SettingsFor(minibatch, source.rollout.chunk_length);
  const int accumulators = static_cast<int>(minibatch.shards.size()) * minibatch.slices;
  for (Side* const side : sides) {
    side->accumulators.resize(accumulators);
    side->losses.resize(accumulators);
  }
  const auto start = std::chrono::steady_clock::now();
  const auto count = static_cast<int>(sides.size());
  pool_.ForEach(count * accumulators, [&](int index, int worker) {
    const int accumulator = index / count;
    const Chunks& shard = minibatch.shards[accumulator / minibatch.slices];
    AccumulateSlice(*sides[index % count], source,
                    SliceOf(shard, accumulator % minibatch.slices, minibatch.slices), settings,
                    accumulator, worker);
  });
  gradient_seconds_ += SecondsSince(start);
  SumAccumulators(sides, minibatch.slices);
}

void PpoUpdate::SumAccumulators(const std::vector<Side*>& sides, int slices) {
  struct Block {
    Side* side;
    std::int64_t begin, end;
  };
  std::vector<Block> blocks;
  for (Side* const side : sides) {
    const auto size = static_cast<std::int64_t>(side->accumulators[0].size());
    for (std::int64_t begin = 0; begin < size; begin += kSumBlock) {
      blocks.push_back({side, begin, std::min(size, begin + kSumBlock)});
    }
  }
  pool_.ForEach(static_cast<int>(blocks.size()), [&](int i, int) {
    SumGradients(blocks[i].begin, blocks[i].end, slices, blocks[i].side->accumulators);
  });
  for (Side* const side : sides) {
    std::vector<LossSums> shards(side->losses.size() / slices);
    for (std::size_t i = 0; i < side->losses.size(); ++i) shards[i / slices] += side->losses[i];
    side->beside = {SumByTree(shards), pool_.stopping()};
  }
}

void PpoUpdate::AddOtherRanks(Side& side) {
  const DenormalsFlushed flushed;  // as where shards are summed within a rank
  SumManyOverRanks(ranks_, side.accumulators[0].size(), side.accumulators[0].data(), side.beside);
}

void PpoUpdate::Step(Side& side, const LearningRates& learning_rates) {
  if (side.beside.stopping > 0) return;
  const DenormalsFlushed flushed;
  AdamOptimiser& optimiser = side.trained.optimiser;
  side.trained.network->FinishGradient(optimiser.parameters(), side.accumulators[0].data(),
                                       optimiser.gradient());
  if (side.trained.idle_pedals) side.trained.idle_pedals->DropGradient(optimiser.gradient());
  const double learning_rate = is_actor(side) ? learning_rates.actor : learning_rates.critic;
  side.norm = ClippedStep(config_.max_gradient_norm, learning_rate, optimiser);
  side.trained.TakeParameters();
}

std::string PpoUpdate::FirstBrokenShard(const Side& side) {
  const std::size_t slices = side.losses.size() / static_cast<std::size_t>(shards_.count);
  int first = shards_.total;
  for (std::size_t i = 0; i < side.losses.size() && first == shards_.total; ++i) {
    if (std::isfinite(side.losses[i].*side.loss)) continue;
    first = shards_.first + static_cast<int>(i / slices);
  }
  return NameFirstBroken(shards_, first, ranks_);
}

void PpoUpdate::RequireSane(const Side& side) {
  const double loss = side.beside.losses.*side.loss;
  if (std::isfinite(loss) && side.norm <= kExplodedGradientNorm) return;
  exploded_ = true;
  const std::string rate = is_actor(side) ? "ppo.learning_rate" : CriticLearningRateKey(config_);
  throw Error("the " + std::string(side.name) + "'s training exploded (loss " +
              RoundedText(loss, kErrorDigits) + ", gradient norm " +
              RoundedText(side.norm, kErrorDigits) + FirstBrokenShard(side) + "); lower " + rate +
              ", or ppo.max_gradient_norm");
}

bool PpoUpdate::AddTo(UpdateReport& report, const Side& side) {
  if (side.beside.stopping > 0) return false;
  RequireSane(side);
  report.losses += side.beside.losses;
  (is_actor(side) ? report.actor_gradient_norm : report.critic_gradient_norm) += side.norm;
  return true;
}

bool PpoUpdate::StepTogether(const Source& source, const Minibatch& minibatch,
                             const LearningRates& learning_rates, UpdateReport& report) {
  auto& [actor, critic] = sides_;
  ComputeGradients(source, minibatch, {&actor, &critic});
  for (Side& side : sides_) AddOtherRanks(side);
  pool_.ForEach(2, [&](int i, int) { Step(sides_[i], learning_rates); });
  return AddTo(report, critic) && AddTo(report, actor);
}

bool PpoUpdate::StepOneByOne(const Source& source, const Minibatch& minibatch,
                             const LearningRates& learning_rates, Stepping& stepping,
                             UpdateReport& report) {
  auto& [actor, critic] = sides_;
  for (Side* const side : {&critic, &actor}) {
    ComputeGradients(source, minibatch, {side});
    if (!Await(stepping, report)) return false;
    stepping = {side, std::async(std::launch::async, [this, side, &learning_rates] {
                  AddOtherRanks(*side);
                  Step(*side, learning_rates);
                })};
  }
  return true;
}

bool PpoUpdate::Await(Stepping& stepping, UpdateReport& report) {
  if (!stepping.done.valid()) return true;
  const auto start = std::chrono::steady_clock::now();
  stepping.done.get();
  report.wait_seconds += SecondsSince(start);
  return AddTo(report, *stepping.side);
}

bool PpoUpdate::IsOneByOne(const Rollout& rollout) {
  if (ranks_.count() == 1) return false;
  const int chunks = rollout.chunks() * rollout.shard_aircraft() / config_.minibatches;
  const int tasks = rollout.shards.count * Slices(chunks, rollout.shards);
  const auto rounds = [&](int of) { return (of + pool_.threads() - 1) / pool_.threads(); };
  return UnionOverRanks(ranks_, 2 * rounds(tasks) > rounds(2 * tasks)) == 0;
}

UpdateReport PpoUpdate::Run(const Rollout& rollout, const ValueScale& scale,
                            std::uint64_t iteration, const LearningRates& learning_rates,
                            double handling_weight) {
  handling_weight_ = handling_weight;
  shards_ = rollout.shards;
  exploded_ = false;
  const Source source = SourceOf(rollout, scale);
  pool_.ForEach(2, [&](int i, int) { sides_[i].trained.TakeParameters(); });
  const bool one_by_one = IsOneByOne(rollout);
  Stepping stepping;
  UpdateReport report;
  gradient_seconds_ = 0;
  for (int epoch = 0; epoch < config_.epochs; ++epoch) {
    const Minibatches minibatches(rollout, config_.minibatches, seed_, iteration, epoch);
    for (int minibatch = 0; minibatch < config_.minibatches; ++minibatch) {
      const Minibatch cut = Cut(minibatches.At(minibatch), rollout);
      report.stopped = one_by_one ? !StepOneByOne(source, cut, learning_rates, stepping, report)
                                  : !StepTogether(source, cut, learning_rates, report);
      if (report.stopped) return report;
    }
  }
  report.stopped = !Await(stepping, report);
  if (report.stopped) return report;
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
