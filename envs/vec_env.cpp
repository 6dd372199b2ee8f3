// SPDX-License-Identifier: Apache-2.0
#include "envs/vec_env.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>
#include <new>
#include <string>

#include "base/denormals.h"
#include "base/error.h"
#include "envs/actions.h"
#include "envs/aircraft/registry.h"
#include "envs/flight_metrics.h"
#include "envs/flight_reset.h"
#include "envs/guided_flight.h"
#include "envs/kernels/plant_kernel.h"
#include "envs/tasks/observation.h"
#include "envs/tasks/reward.h"
#include "envs/tasks/task.h"
#include "envs/wind/wind.h"

namespace skein {
namespace {

// Aircraft that go through all of a policy step's control steps together: their columns stay in the
// innermost caches.
constexpr int kBlock = 128;
static_assert(kBlock <= GuidedFlight::kMaxCount);
constexpr int kLaneMultiple = 32;
constexpr std::size_t kCacheLine = 64;

struct AlignedDelete {
  void operator()(std::byte* bytes) const {
    ::operator delete[](bytes, std::align_val_t{kCacheLine});
  }
};

using AlignedBytes = std::unique_ptr<std::byte[], AlignedDelete>;

AlignedBytes AllocateZeros(std::size_t size) {
  void* const memory = ::operator new[](size, std::align_val_t{kCacheLine});
  return AlignedBytes(static_cast<std::byte*>(std::memset(memory, 0, size)));
}

int RoundUp(int count, int multiple) { return (count + multiple - 1) / multiple * multiple; }

/// What a block needs during a policy step only.
struct alignas(kCacheLine) PolicyStepScratch {
  float pilot[kActionSize][kBlock];
  float step_reward[kBlock];
  float policy_step_reward[kBlock];
  std::int32_t reached[kBlock];
  std::int32_t termination[kBlock];
  GuidedFlight::PolicyStep guidance;  // with a low-level policy

  PilotColumns pilot_columns() const { return {pilot[0], pilot[1], pilot[2], pilot[3]}; }
};

Aircraft ConfiguredAircraft(const EnvConfig& config) {
  Aircraft aircraft = LoadAircraft(config.aircraft);
  aircraft.airframe.cg = config.cg;
  aircraft.airframe.engine_angular_momentum = config.engine_angular_momentum;
  const auto require = [&](bool asked, const MachFunction& function, const char* key) {
    if (!asked || !function.mach.empty()) return;
    throw Error("configuration: " + std::string(key) + " = true, but the aircraft " +
                config.aircraft + " has no data for it; it must be false");
  };
  require(config.thrust_grows, aircraft.engine.growth, "env.thrust_growth_above_mach_1");
  require(config.drag_rises, aircraft.drag_rise, "env.drag_rise");
  aircraft.engine.grows = config.thrust_grows;
  aircraft.drag_rises = config.drag_rises;
  return aircraft;
}

const EnvConfig& Validated(const EnvConfig& config) {
  Validate(config);
  return config;
}

}  // namespace

struct VecEnv::Impl {
  /// A run of at most kBlock aircraft of one tile.
  struct Block {
    Tile flight, task;
    float* episode_return;
    std::int32_t* step;
    std::int32_t* episode;
    int first_aircraft;
    int count;
  };

  Impl(const EnvConfig& environment, int aircraft_count, std::uint64_t random_seed,
       int requested_tile_size, std::shared_ptr<const Policy> low_level)
      : config(Validated(environment)),
        num_aircraft(aircraft_count),
        seed(random_seed),
        task(MakeTask(config)),
        aircraft(ConfiguredAircraft(config)),
        kernel_aircraft(MakeKernelAircraft(aircraft, config.atmosphere)),
        flight_control(aircraft, config.flight_control, config.control_interval_s),
        limits(config),
        reset(config, aircraft),
        wind(config.wind),
        flight_columns(wind.enabled() ? kNumWindyColumns : kNumColumns) {
    if (aircraft_count < 1) {
      throw Error("environment: " + std::to_string(aircraft_count) +
                  " aircraft, but there must be at least 1");
    }
    if (requested_tile_size < 1) {
      throw Error("environment: tiles of " + std::to_string(requested_tile_size) +
                  " aircraft, but a tile must have at least 1");
    }
    if (low_level != nullptr) {
      guided = std::make_unique<GuidedFlight>(config, num_aircraft, std::move(low_level));
    }
    tile_size = RoundUp(std::min(requested_tile_size, num_aircraft), kLaneMultiple);
    num_tiles = (num_aircraft + tile_size - 1) / tile_size;
    blocks_per_tile = (tile_size + kBlock - 1) / kBlock;
    stride = TileStride(std::min(tile_size, kBlock));
    block_size = WordsPerAircraft() * stride * sizeof(float);
    num_blocks = static_cast<std::size_t>(blocks_per_tile) * static_cast<std::size_t>(num_tiles);
    memory = AllocateZeros(block_size * num_blocks);
    metric_sums.resize(num_blocks);
    for (int tile = 0; tile < num_tiles; ++tile) {
      for (int begin = 0; begin < CountOf(tile); begin += kBlock) {
        const Block block = BlockOf(tile, begin);
        for (int i = 0; i < block.count; ++i) BeginEpisode(block, i, 0);
        FillPadding(block);
      }
    }
  }

  int CountOf(int tile) const { return std::min(tile_size, num_aircraft - tile * tile_size); }

  /// The block that begins at, or holds from there on, the tile's aircraft `begin`.
  Block BlockOf(int tile, int begin) const {
    std::byte* const bytes =
        memory.get() +
        block_size * static_cast<std::size_t>(tile * blocks_per_tile + begin / kBlock);
    const int lane = begin % kBlock;
    float* const base = reinterpret_cast<float*>(bytes) + lane;
    const int count = std::min(kBlock - lane, CountOf(tile) - begin);
    Block block;
    block.flight = {base, stride, count, wind.enabled()};
    block.task = {block.flight[flight_columns], stride, count};
    block.episode_return = block.task[task->num_columns()];
    block.step = reinterpret_cast<std::int32_t*>(block.episode_return + stride);
    block.episode = block.step + stride;
    block.first_aircraft = tile * tile_size + begin;
    block.count = count;
    return block;
  }

  simd::RandomStream Stream(const Block& block, int i, simd::RandomPurpose purpose) const {
    simd::RandomKey key;
    key.seed = seed;
    key.a = static_cast<std::uint32_t>(block.first_aircraft + i);
    key.b = static_cast<std::uint32_t>(block.episode[i]);
    key.purpose = purpose;
    return simd::RandomStream(key);
  }

  GustKeys KeysOf(const Block& block) const {
    return {seed, static_cast<std::uint32_t>(block.first_aircraft), block.episode, block.step};
  }

  void BeginEpisode(const Block& block, int i, std::int32_t episode) const {
    block.episode[i] = episode;
    block.step[i] = 0;
    block.episode_return[i] = 0;
    if (guided != nullptr) guided->Forget(block.first_aircraft + i);
    simd::RandomStream initial = Stream(block, i, simd::RandomPurpose::kInitialState);
    const FreshFlight flight = reset.Draw(&initial);
    for (int column = 0; column < kNumColumns; ++column) {
      block.flight[column][i] = flight.columns[static_cast<std::size_t>(column)];
    }
    if (wind.enabled()) wind.Begin(block.flight, i, KeysOf(block));
    simd::RandomStream target = Stream(block, i, simd::RandomPurpose::kTarget);
    task->Reset(flight.start, &target, block.task, i);
    if (config.stagger_clocks && episode == 0) {
      simd::RandomStream clock = Stream(block, i, simd::RandomPurpose::kClockStagger);
      block.step[i] = static_cast<std::int32_t>(clock.Uniform(0, config.time_limit_steps));
    }
  }

  /// Lanes beyond the last aircraft fly copies of the first, so that kernels meet only sound
  /// states there.
  void FillPadding(const Block& block) const {
    const int padded = RoundUp(block.count, kLaneMultiple);
    for (int column = 0; column < flight_columns; ++column) {
      std::fill(block.flight[column] + block.count, block.flight[column] + padded,
                block.flight[column][0]);
    }
    for (int column = 0; column < task->num_columns(); ++column) {
      std::fill(block.task[column] + block.count, block.task[column] + padded,
                block.task[column][0]);
    }
    std::fill(block.step + block.count, block.step + padded, 0);
    std::fill(block.episode_return + block.count, block.episode_return + padded, 0.0f);
  }

  ObservationNoise NoiseOf(const Block& block) const {
    ObservationNoise noise;
    noise.standard_deviation = config.observation_noise;
    noise.max_standard_deviation = config.observation_noise_max;
    noise.seed = seed;
    noise.first_aircraft = static_cast<std::uint32_t>(block.first_aircraft);
    noise.episode = block.episode;
    noise.step = block.step;
    return noise;
  }

  void Observe(const Block& block, float* observation) const {
    alignas(kCacheLine) float errors[kNumTaskErrors * kBlock];
    task->Errors(block.flight, block.task, errors, kBlock);
    ObserveTile(*kernel_aircraft, block.flight, errors, kBlock, NoiseOf(block), observation);
    if (guided != nullptr && guided->averages()) {
      guided->Average(block.first_aircraft, block.count, observation);
    }
  }

  /// Keeps what the low-level policy has just seen for the high-level policy's next observation.
  void AccumulateObservations(const Block& block, const PolicyStepScratch& scratch) const {
    static_assert(kBlock == GuidedFlight::kMaxCount);
    alignas(kCacheLine) float errors[kNumTaskErrors * kBlock];
    task->Errors(block.flight, block.task, errors, kBlock);
    guided->AccumulateObservations(block.first_aircraft, block.count, errors, scratch.guidance);
  }

  /// Copies the observations of aircraft whose time ran out in this control step.
  void ObserveTruncated(const Block& block, const PolicyStepScratch& scratch, bool* written,
                        float* final_observation) const {
    const auto is_new = [&](int i) {
      return scratch.termination[i] == static_cast<std::int32_t>(Termination::kTimeLimit) &&
             !written[i];
    };
    bool any = false;
    for (int i = 0; i < block.count; ++i) any = any || is_new(i);
    if (!any) return;
    float observation[kBlock * kObservationSize];
    Observe(block, observation);
    for (int i = 0; i < block.count; ++i) {
      if (!is_new(i)) continue;
      std::copy_n(observation + i * kObservationSize, kObservationSize,
                  final_observation + i * kObservationSize);
      written[i] = true;
    }
  }

  float Recorded(const Block& block, int column, int i) const {
    return column < flight_columns ? block.flight[column][i] : 0;
  }

  /// Of the block of one tile, which one thread drives.
  FlightMetricSums& MetricSums(const Block& block) const {
    const int tile = block.first_aircraft / tile_size;
    const int place = block.first_aircraft % tile_size / kBlock;
    return metric_sums[static_cast<std::size_t>(tile * blocks_per_tile + place)];
  }

  /// Reports the episodes that ended and begins new ones.
  void RestartEnded(const Block& block, const PolicyStepScratch& scratch,
                    const StepOutput& output) const {
    for (int i = 0; i < block.count; ++i) {
      if (scratch.termination[i] == static_cast<std::int32_t>(Termination::kNone)) continue;
      output.episode_return[i] = block.episode_return[i];
      output.episode_steps[i] = block.step[i];
      FlightMetricSums& metrics = MetricSums(block);
      if (output.flight_metrics != nullptr) {
        float* const row = output.flight_metrics + i * kNumFlightMetrics;
        metrics.Report(i, block.step[i], config.control_interval_s, row);
        // Not every column that is not finite shows in them, nor is every infinity NaN.
        if (scratch.termination[i] == static_cast<std::int32_t>(Termination::kNonFinite)) {
          std::fill_n(row, kNumFlightMetrics, std::numeric_limits<float>::quiet_NaN());
        }
      }
      metrics.Begin(i);
      BeginEpisode(block, i, block.episode[i] + 1);
    }
  }

  /// Has the low-level policy, if there is one, decide when it is due. Returns the stick actions
  /// that hold during the control step.
  const float* TakeSticks(const Block& block, const float* action, int step,
                          PolicyStepScratch& scratch) const {
    const bool is_first = step == 0;
    if (guided == nullptr) {
      if (is_first) TakeActions(action, block.flight, scratch.pilot[0], kBlock);
      return action;
    }
    if (is_first) {
      guided->Plan(action, block.flight, scratch.guidance);
      guided->ResetObservationMean(block.first_aircraft, block.count);
    }
    if (guided->IsPolicyStep(step)) {
      guided->Act(*kernel_aircraft, block.flight, NoiseOf(block), scratch.guidance);
      // The first look is the one that the high-level policy has just decided by.
      if (guided->averages() && !is_first) AccumulateObservations(block, scratch);
      TakeActions(scratch.guidance.stick, block.flight, scratch.pilot[0], kBlock);
    }
    return scratch.guidance.stick;
  }

  /// Judges a control step, and shows it to the observer, if there is one.
  void ComputeReward(const Block& block, const StepResult& step_result,
                     const EpisodeColumns& episodes, const float* stick,
                     ControlStepObserver* observer) const {
    task->ComputeReward(block.flight, block.task, block.step, step_result);
    if (observer == nullptr) {
      ComputeRewardAndTermination(*kernel_aircraft, limits, block.flight, step_result, episodes);
      return;
    }
    alignas(kCacheLine) float reward[kBlock] = {};
    EpisodeColumns step = episodes;
    step.policy_step_reward = reward;
    ComputeRewardAndTermination(*kernel_aircraft, limits, block.flight, step_result, step);
    for (int i = 0; i < block.count; ++i) episodes.policy_step_reward[i] += reward[i];
    observer->See({block.first_aircraft, block.flight, stick, reward, episodes.termination});
  }

  /// `output` points at the block's first aircraft.
  void Step(const Block& block, const float* action, const StepOutput& output) const {
    PolicyStepScratch scratch;
    std::fill(std::begin(scratch.policy_step_reward), std::end(scratch.policy_step_reward), 0.0f);
    std::fill(std::begin(scratch.termination), std::end(scratch.termination), 0);
    const StepResult step_result{scratch.step_reward, scratch.reached};
    const EpisodeColumns episodes{block.step, scratch.termination, scratch.policy_step_reward,
                                  block.episode_return};
    const bool keeps_final = config.truncate_at_time_limit && output.final_observation != nullptr;
    bool written[kBlock] = {};
    const float dt = static_cast<float>(config.control_interval_s);
    for (int step = 0; step < config.action_repeat; ++step) {
      const float* const stick = TakeSticks(block, action, step, scratch);
      if (wind.enabled()) wind.Advance(block.flight, dt, KeysOf(block));
      ControlTile(*kernel_aircraft, flight_control, block.flight, scratch.pilot_columns());
      // The next block's memory is needed after this one's last control step.
      const bool is_last = step + 1 == config.action_repeat;
      StepTile(*kernel_aircraft, block.flight, dt, config.substeps,
               is_last ? MemoryBehind(block) : MemoryAhead());
      if (output.flight_metrics != nullptr) {
        MetricSums(block).Add(*kernel_aircraft, block.flight, scratch.termination);
      }
      ComputeReward(block, step_result, episodes, stick, output.observer);
      if (keeps_final) ObserveTruncated(block, scratch, written, output.final_observation);
    }
    std::copy_n(scratch.policy_step_reward, block.count, output.reward);
    std::copy_n(scratch.termination, block.count, output.termination);
    // Endings are rare: most blocks have none.
    std::int32_t any_ended = 0;
    for (int i = 0; i < block.count; ++i) any_ended |= scratch.termination[i];
    if (any_ended != 0) RestartEnded(block, scratch, output);
    if (block.count % kLaneMultiple != 0) FillPadding(block);
  }

  /// Where the `index`-th mutable 32-bit word of the block's first aircraft lies.
  void* WordAt(const Block& block, std::size_t index) const {
    const std::size_t floats = WordsPerAircraft() - 2;
    if (index < floats) return block.flight[static_cast<int>(index)];
    return index == floats ? block.step : block.episode;
  }

  /// The block that follows in memory.
  MemoryAhead MemoryBehind(const Block& block) const {
    const auto* const next = reinterpret_cast<const std::byte*>(block.flight.base) + block_size;
    if (next >= memory.get() + block_size * num_blocks) return {};
    return {next, block_size};
  }

  std::size_t WordsPerAircraft() const {
    return static_cast<std::size_t>(flight_columns + task->num_columns() + 1 + 2);
  }

  int MemorySize() const { return guided == nullptr ? 0 : guided->memory_size(); }

  std::size_t SnapshotWords() const {
    return (WordsPerAircraft() + static_cast<std::size_t>(MemorySize())) *
           static_cast<std::size_t>(num_aircraft);
  }

  /// Every mutable 32-bit word of every aircraft, aircraft by aircraft.
  template <typename Visit>
  void VisitWords(const Visit& visit) const {
    const std::size_t words = WordsPerAircraft();
    for (int index = 0; index < num_aircraft; ++index) {
      const Block block = BlockHolding(index);
      for (std::size_t k = 0; k < words; ++k) visit(WordAt(block, k));
      for (int k = 0; k < MemorySize(); ++k) visit(guided->memory(index, k));
    }
  }

  Block BlockHolding(int index) const {
    if (index < 0 || index >= num_aircraft) {
      throw Error("environment: no aircraft " + std::to_string(index) + " among " +
                  std::to_string(num_aircraft));
    }
    return BlockOf(index / tile_size, index % tile_size);
  }

  EnvConfig config;
  int num_aircraft;
  std::uint64_t seed;
  std::unique_ptr<Task> task;
  Aircraft aircraft;
  std::shared_ptr<const KernelAircraft> kernel_aircraft;
  FlightControlConstants flight_control;
  TerminationLimits limits;
  FlightReset reset;
  Wind wind;
  int flight_columns;
  std::unique_ptr<GuidedFlight> guided;  // null without a low-level policy

  int tile_size = 0;
  int num_tiles = 0;
  std::size_t stride = 0;  // of a block's columns
  int blocks_per_tile = 0;
  std::size_t num_blocks = 0;
  /// Per block of a tile: physical columns, task columns, episode return (float32), control steps
  /// of the episode and its number (int32), each `stride` long. What is worked on together lies
  /// together.
  AlignedBytes memory;
  std::size_t block_size = 0;  // bytes
  /// By block, each a cache of what its episodes did so far: no part of the environment's state.
  mutable std::vector<FlightMetricSums> metric_sums;
};

VecEnv::VecEnv(const EnvConfig& config, int num_aircraft, std::uint64_t seed, int tile_size,
               std::shared_ptr<const Policy> low_level)
    : impl_(std::make_unique<Impl>(config, num_aircraft, seed, tile_size, std::move(low_level))) {}
VecEnv::~VecEnv() = default;
VecEnv::VecEnv(VecEnv&&) noexcept = default;

const EnvConfig& VecEnv::config() const { return impl_->config; }
int VecEnv::num_aircraft() const { return impl_->num_aircraft; }
int VecEnv::num_tiles() const { return impl_->num_tiles; }
int VecEnv::tile_begin(int tile) const { return tile * impl_->tile_size; }
int VecEnv::tile_count(int tile) const { return impl_->CountOf(tile); }
int VecEnv::observation_size() const { return kObservationSize; }
int VecEnv::action_size() const {
  return impl_->guided != nullptr ? kHighLevelActionSize : kActionSize;
}

void VecEnv::Observe(int tile, float* observation) const {
  const simd::DenormalsFlushed flushed;
  for (int begin = 0; begin < tile_count(tile); begin += kBlock) {
    impl_->Observe(impl_->BlockOf(tile, begin),
                   observation + static_cast<std::size_t>(begin) * kObservationSize);
  }
}

void VecEnv::Step(int tile, const float* action, const StepOutput& output) {
  // Also where the caller's thread does not: results must not depend on who drives the tile.
  const simd::DenormalsFlushed flushed;
  for (int begin = 0; begin < tile_count(tile); begin += kBlock) {
    const std::size_t row = static_cast<std::size_t>(begin);
    StepOutput part = output;
    part.reward += begin;
    part.termination += begin;
    part.episode_return += begin;
    part.episode_steps += begin;
    if (part.final_observation != nullptr) {
      part.final_observation += row * kObservationSize;
    }
    if (part.flight_metrics != nullptr) {
      part.flight_metrics += row * kNumFlightMetrics;
    }
    impl_->Step(impl_->BlockOf(tile, begin), action + row * static_cast<std::size_t>(action_size()),
                part);
  }
}

std::vector<std::uint32_t> VecEnv::Snapshot() const {
  std::vector<std::uint32_t> snapshot(impl_->SnapshotWords());
  std::uint32_t* target = snapshot.data();
  impl_->VisitWords([&target](const void* word) { std::memcpy(target++, word, sizeof *target); });
  return snapshot;
}

void VecEnv::Restore(const std::vector<std::uint32_t>& snapshot) {
  if (snapshot.size() != impl_->SnapshotWords()) {
    throw Error("environment: a snapshot of " + std::to_string(snapshot.size()) +
                " words does not fit " + std::to_string(num_aircraft()) + " aircraft, which take " +
                std::to_string(impl_->SnapshotWords()));
  }
  for (FlightMetricSums& sums : impl_->metric_sums) sums.Clear();
  const std::uint32_t* source = snapshot.data();
  impl_->VisitWords([&source](void* word) { std::memcpy(word, source++, sizeof *source); });
  for (int tile = 0; tile < num_tiles(); ++tile) {
    for (int begin = 0; begin < tile_count(tile); begin += kBlock) {
      impl_->FillPadding(impl_->BlockOf(tile, begin));
    }
  }
}

float VecEnv::StateOf(int aircraft, int column) const {
  if (column < 0 || column >= kNumWindyColumns) {
    throw Error("environment: no state column " + std::to_string(column));
  }
  return impl_->Recorded(impl_->BlockHolding(aircraft), column, 0);
}

std::vector<float> VecEnv::TargetOf(int aircraft) const {
  const Impl::Block block = impl_->BlockHolding(aircraft);
  std::vector<float> target;
  for (int column = 0; column < impl_->task->num_targets(); ++column) {
    target.push_back(block.task[column][0]);
  }
  return target;
}

}  // namespace skein
