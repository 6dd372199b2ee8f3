// SPDX-License-Identifier: Apache-2.0
#include "envs/env_storage.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "base/error.h"

namespace skein {
namespace {

constexpr int kLaneMultiple = 32;

int RoundUp(int count, int multiple) { return (count + multiple - 1) / multiple * multiple; }

}  // namespace

EnvStorage::EnvStorage(int num_aircraft, int requested_tile_size, const EnvColumns& columns)
    : num_aircraft_(num_aircraft),
      columns_(columns),
      flight_columns_(Tile{nullptr, 0, 0, columns.windy, columns.rotational_gusts}.num_columns()) {
  tile_size_ = RoundUp(std::min(requested_tile_size, num_aircraft), kLaneMultiple);
  num_tiles_ = (num_aircraft + tile_size_ - 1) / tile_size_;
  blocks_per_tile_ = (tile_size_ + kAircraftPerBlock - 1) / kAircraftPerBlock;
  stride_ = TileStride(std::min(tile_size_, kAircraftPerBlock));
  num_blocks_ = static_cast<std::size_t>(blocks_per_tile_) * static_cast<std::size_t>(num_tiles_);
  block_bytes_ = words_per_aircraft() * stride_ * sizeof(float);
  memory_ = LargeMemory(block_bytes_ * num_blocks_);
  newest_slots_.assign(num_blocks_, {});
}

int EnvStorage::tile_count(int tile) const {
  return std::min(tile_size_, num_aircraft_ - tile * tile_size_);
}

EnvBlock EnvStorage::BlockAt(int tile, int begin) {
  const int lane = begin % kAircraftPerBlock;
  EnvBlock block;
  block.index = static_cast<std::size_t>(tile * blocks_per_tile_ + begin / kAircraftPerBlock);
  block.first_aircraft = tile * tile_size_ + begin;
  block.count = std::min(kAircraftPerBlock - lane, tile_count(tile) - begin);
  float* const base = reinterpret_cast<float*>(memory_.data() + block_bytes_ * block.index) + lane;
  block.flight = {base, stride_, block.count, columns_.windy, columns_.rotational_gusts};
  block.task = {block.flight[flight_columns_], stride_, block.count};
  block.last_action = {block.task[columns_.task], stride_, block.count};
  float* const plants = block.last_action[columns_.last_action];
  if (columns_.plant > 0) {
    block.plants = {{plants, stride_, block.count}, columns_.plant == kNumPlantColumnsWithSensors};
  }
  block.episode_return = plants + static_cast<std::size_t>(columns_.plant) * stride_;
  block.step = reinterpret_cast<std::int32_t*>(block.episode_return + stride_);
  block.episode = block.step + stride_;
  if (columns_.progress) {
    std::int32_t* const first = block.episode + stride_;
    block.progress = {first, first + stride_, first + 2 * stride_, first + 3 * stride_,
                      first + 4 * stride_};
  }
  block.delay_line = {columns_.delays, block.flight[float_columns() + int_columns()], stride_,
                      &newest_slots_[block.index]};
  return block;
}

EnvBlock EnvStorage::BlockFrom(int aircraft) {
  if (aircraft < 0 || aircraft >= num_aircraft_) {
    throw Error("environment: no aircraft " + std::to_string(aircraft) + " among " +
                std::to_string(num_aircraft_));
  }
  return BlockAt(aircraft / tile_size_, aircraft % tile_size_);
}

MemoryAhead EnvStorage::MemoryAfter(const EnvBlock& block) const {
  if (block.index + 1 >= num_blocks_) return {};
  return {memory_.data() + block_bytes_ * (block.index + 1), block_bytes_};
}

std::size_t EnvStorage::words_per_aircraft() const {
  return static_cast<std::size_t>(float_columns() + int_columns() + columns_.delays.columns());
}

int EnvStorage::float_columns() const {
  return flight_columns_ + columns_.task + columns_.last_action + columns_.plant + 1;
}

int EnvStorage::int_columns() const {
  return 2 + (columns_.progress ? EpisodeProgress::kNumColumns : 0);
}

void* EnvStorage::WordAt(const EnvBlock& block, std::size_t index) const {
  // All columns lie one behind the other, the first that of the flight. The delay line's come last,
  // and turn.
  const int column = static_cast<int>(index), of_delays = column - float_columns() - int_columns();
  if (of_delays < 0) return block.flight[column];
  return block.delay_line.Column(of_delays);
}

void EnvStorage::Save(int aircraft, std::uint32_t* words) {
  const EnvBlock block = BlockFrom(aircraft);
  for (std::size_t k = 0; k < words_per_aircraft(); ++k) {
    std::memcpy(words + k, WordAt(block, k), sizeof *words);
  }
}

void EnvStorage::Restore(int aircraft, const std::uint32_t* words) {
  const EnvBlock block = BlockFrom(aircraft);
  for (std::size_t k = 0; k < words_per_aircraft(); ++k) {
    std::memcpy(WordAt(block, k), words + k, sizeof *words);
  }
}

void EnvStorage::FillPadding(const EnvBlock& block) {
  const int padded = RoundUp(block.count, kLaneMultiple);
  if (padded == block.count) return;
  const auto copy_first = [&](const Tile& tile, int columns) {
    for (int column = 0; column < columns; ++column) {
      std::fill(tile[column] + block.count, tile[column] + padded, tile[column][0]);
    }
  };
  copy_first(block.flight, flight_columns_);
  copy_first(block.task, columns_.task);
  copy_first(block.plants.columns, columns_.plant);
  std::fill(block.step + block.count, block.step + padded, 0);
  std::fill(block.episode_return + block.count, block.episode_return + padded, 0.0f);
}

}  // namespace skein
