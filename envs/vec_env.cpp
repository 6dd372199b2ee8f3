// SPDX-License-Identifier: Apache-2.0
#include "envs/vec_env.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "base/denormals.h"
#include "base/error.h"
#include "envs/actions.h"
#include "envs/env_stepper.h"
#include "envs/env_storage.h"
#include "envs/flight_metrics.h"
#include "envs/low_level_flight.h"
#include "envs/tasks/observation.h"
#include "envs/tasks/task.h"

namespace skein {
namespace {

int RequireAircraft(int num_aircraft) {
  if (num_aircraft >= 1) return num_aircraft;
  throw Error("environment: " + std::to_string(num_aircraft) +
              " aircraft, but there must be at least 1");
}

int RequireTileSize(int tile_size) {
  if (tile_size >= 1) return tile_size;
  throw Error("environment: tiles of " + std::to_string(tile_size) +
              " aircraft, but a tile must have at least 1");
}

void RequireTile(int tile, int num_tiles) {
  if (tile >= 0 && tile < num_tiles) return;
  throw Error("environment: no tile " + std::to_string(tile) + " among " +
              std::to_string(num_tiles));
}

void RequireColumn(int column) {
  if (column >= 0 && column < kNumRotationalGustColumns) return;
  throw Error("environment: no state column " + std::to_string(column));
}

}  // namespace

struct VecEnv::Impl {
  Impl(const EnvConfig& config, int num_aircraft, std::uint64_t seed, int tile_size,
       std::shared_ptr<const Policy> low_level, int first_aircraft)
      : stepper(config, seed, RequireAircraft(num_aircraft), std::move(low_level), first_aircraft),
        storage(num_aircraft, RequireTileSize(tile_size), stepper.columns()) {
    Restart();
  }

  void Restart() {
    stepper.ResetMetrics(storage.num_blocks());
    storage.ForEachBlock([this](const EnvBlock& block) {
      for (int i = 0; i < block.count; ++i) stepper.BeginEpisode(block, i, 0);
      storage.FillPadding(block);
    });
  }

  std::size_t snapshot_words_per_aircraft() const {
    const LowLevelFlight* const low_level = stepper.low_level();
    return storage.words_per_aircraft() + (low_level == nullptr ? 0 : low_level->memory_words());
  }
  std::size_t snapshot_words() const {
    return snapshot_words_per_aircraft() * static_cast<std::size_t>(storage.num_aircraft());
  }

  EnvStepper stepper;
  EnvStorage storage;
};

VecEnv::VecEnv(const EnvConfig& config, int num_aircraft, std::uint64_t seed, int tile_size,
               std::shared_ptr<const Policy> low_level, int first_aircraft)
    : impl_(std::make_unique<Impl>(config, num_aircraft, seed, tile_size, std::move(low_level),
                                   first_aircraft)) {}
VecEnv::~VecEnv() = default;
VecEnv::VecEnv(VecEnv&&) noexcept = default;

const EnvConfig& VecEnv::config() const { return impl_->stepper.config(); }
int VecEnv::num_aircraft() const { return impl_->storage.num_aircraft(); }
int VecEnv::first_aircraft() const { return impl_->stepper.first_aircraft(); }
int VecEnv::num_tiles() const { return impl_->storage.num_tiles(); }
int VecEnv::tile_begin(int tile) const {
  RequireTile(tile, num_tiles());
  return impl_->storage.tile_begin(tile);
}
int VecEnv::tile_count(int tile) const {
  RequireTile(tile, num_tiles());
  return impl_->storage.tile_count(tile);
}
int VecEnv::observation_size() const { return impl_->stepper.observation_size(); }
int VecEnv::action_size() const { return impl_->stepper.action_size(); }

void VecEnv::Observe(int tile, float* observation) const {
  const DenormalsFlushed flushed;
  const int count = tile_count(tile);
  for (int begin = 0; begin < count; begin += kAircraftPerBlock) {
    impl_->stepper.Observe(impl_->storage.BlockAt(tile, begin),
                           observation + static_cast<std::size_t>(begin * observation_size()));
  }
}

int VecEnv::privileged_size() const { return impl_->stepper.privileged().size(); }
std::vector<std::string> VecEnv::privileged_names() const {
  return impl_->stepper.privileged().names();
}

void VecEnv::ObservePrivileged(int tile, float* rows) const {
  const DenormalsFlushed flushed;
  const auto size = static_cast<std::size_t>(privileged_size());
  const int count = tile_count(tile);
  for (int begin = 0; begin < count; begin += kAircraftPerBlock) {
    impl_->stepper.ObservePrivileged(impl_->storage.BlockAt(tile, begin),
                                     rows + static_cast<std::size_t>(begin) * size);
  }
}

void VecEnv::Step(int tile, const float* action, const StepOutput& output) {
  // Also where the caller's thread does not: results must not depend on who drives the tile.
  const DenormalsFlushed flushed;
  const int count = tile_count(tile);
  for (int begin = 0; begin < count; begin += kAircraftPerBlock) {
    const std::size_t row = static_cast<std::size_t>(begin);
    StepOutput part = output;
    part.reward += begin;
    part.termination += begin;
    part.episode_return += begin;
    part.episode_steps += begin;
    if (part.first_clock != nullptr) part.first_clock += begin;
    if (part.final_observation != nullptr) {
      part.final_observation += row * static_cast<std::size_t>(observation_size());
    }
    if (part.final_privileged != nullptr) {
      part.final_privileged += row * static_cast<std::size_t>(privileged_size());
    }
    if (part.flight_metrics != nullptr) part.flight_metrics += row * kNumFlightMetrics;
    const EnvBlock block = impl_->storage.BlockAt(tile, begin);
    impl_->stepper.Step(block, action + row * static_cast<std::size_t>(action_size()), part,
                        impl_->storage.MemoryAfter(block));
    impl_->storage.FillPadding(block);
  }
}

void VecEnv::Restart(int tile, const bool* begins) {
  const DenormalsFlushed flushed;
  const int count = tile_count(tile);
  for (int begin = 0; begin < count; begin += kAircraftPerBlock) {
    const EnvBlock block = impl_->storage.BlockAt(tile, begin);
    for (int i = 0; i < block.count; ++i) {
      if (begins[begin + i]) impl_->stepper.BeginNextEpisode(block, i);
    }
    impl_->storage.FillPadding(block);
  }
}

void VecEnv::SetHandlingWeight(double weight) { impl_->stepper.SetHandlingWeight(weight); }
void VecEnv::SetConditionShare(double share) { impl_->stepper.SetConditionShare(share); }
void VecEnv::SetTimeLimitShare(double share) { impl_->stepper.SetTimeLimitShare(share); }
void VecEnv::Restart() { impl_->Restart(); }

std::vector<std::uint32_t> VecEnv::Snapshot() const {
  std::vector<std::uint32_t> snapshot(impl_->snapshot_words());
  const std::size_t size = impl_->snapshot_words_per_aircraft();
  for (int i = 0; i < num_aircraft(); ++i) {
    std::uint32_t* const words = snapshot.data() + size * static_cast<std::size_t>(i);
    impl_->storage.Save(i, words);
    if (const LowLevelFlight* const low_level = impl_->stepper.low_level()) {
      low_level->SaveMemory(i, words + impl_->storage.words_per_aircraft());
    }
  }
  return snapshot;
}

void VecEnv::Restore(const std::vector<std::uint32_t>& snapshot) {
  if (snapshot.size() != impl_->snapshot_words()) {
    throw Error("environment: a snapshot of " + std::to_string(snapshot.size()) +
                " words does not fit " + std::to_string(num_aircraft()) + " aircraft, which take " +
                std::to_string(impl_->snapshot_words()));
  }
  const std::size_t size = impl_->snapshot_words_per_aircraft();
  for (int i = 0; i < num_aircraft(); ++i) {
    const std::uint32_t* const words = snapshot.data() + size * static_cast<std::size_t>(i);
    impl_->storage.Restore(i, words);
    if (LowLevelFlight* const low_level = impl_->stepper.low_level()) {
      low_level->RestoreMemory(i, words + impl_->storage.words_per_aircraft());
    }
  }
  impl_->stepper.ResetMetrics(impl_->storage.num_blocks());
  impl_->storage.ForEachBlock([this](const EnvBlock& block) { impl_->storage.FillPadding(block); });
}

float VecEnv::StateOf(int aircraft, int column) const {
  RequireColumn(column);
  const Tile flight = impl_->storage.BlockFrom(aircraft).flight;
  return column < flight.num_columns() ? flight[column][0] : 0;
}

void VecEnv::ReadColumn(int tile, int column, float* values) const {
  RequireColumn(column);
  const int count = tile_count(tile);
  for (int begin = 0; begin < count; begin += kAircraftPerBlock) {
    const EnvBlock block = impl_->storage.BlockAt(tile, begin);
    if (column < block.flight.num_columns()) {
      std::copy_n(block.flight[column], block.count, values + begin);
    } else {
      std::fill_n(values + begin, block.count, 0.0f);
    }
  }
}

std::vector<float> VecEnv::TargetOf(int aircraft) const {
  const Tile task = impl_->storage.BlockFrom(aircraft).task;
  std::vector<float> target;
  for (int column = 0; column < impl_->stepper.task().num_targets(); ++column) {
    target.push_back(task[column][0]);
  }
  return target;
}

void VecEnv::SetTarget(int aircraft, const std::vector<float>& target) {
  const Task& task = impl_->stepper.task();
  if (target.size() != static_cast<std::size_t>(task.num_targets())) {
    throw Error("environment: a target of " + std::to_string(target.size()) +
                " numbers, but the task's have " + std::to_string(task.num_targets()));
  }
  if (!std::all_of(target.begin(), target.end(), [](float x) { return std::isfinite(x); })) {
    throw Error("environment: a target that is not finite");
  }
  const Tile columns = impl_->storage.BlockFrom(aircraft).task;
  for (std::size_t k = 0; k < target.size(); ++k) columns[static_cast<int>(k)][0] = target[k];
  task.FollowTargets(columns, 0);
}

}  // namespace skein
