// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/large_memory.h"
#include "envs/kernels/plant_kernel.h"
#include "envs/plant/delay_line.h"
#include "envs/plant/plant_columns.h"
#include "envs/state/state.h"
#include "envs/tasks/episode_progress.h"

namespace skein {

/// Aircraft that go through all of a policy step's control steps together: their columns stay in
/// the innermost caches.
inline constexpr int kAircraftPerBlock = 128;

/// A view of at most kAircraftPerBlock consecutive aircraft of one tile.
struct EnvBlock {
  Tile flight;                      ///< physical columns (envs/state/state.h)
  Tile task;                        ///< the task's columns
  Tile last_action;                 ///< of the last policy step, where it is remembered
  PlantTile plants;                 ///< where they are drawn
  DelayLine delay_line;             ///< where there are delays
  float* episode_return = nullptr;  ///< of the episodes under way
  std::int32_t* step = nullptr;     ///< control steps of the episode
  std::int32_t* episode = nullptr;  ///< its number
  EpisodeProgress progress;
  int first_aircraft = 0;  ///< index in the environment
  int count = 0;
  std::size_t index = 0;  ///< of the block in memory
};

/// What an environment remembers of each aircraft, beside its episode's return, clock and number.
struct EnvColumns {
  bool windy = false;
  int task = 0;                   ///< columns of the task
  int last_action = 0;            ///< remembered actions of the last policy step
  int plant = 0;                  ///< columns of PlantColumn; 0: every plant is nominal
  Delays delays = {};             ///< of the delay line
  bool progress = false;          ///< EpisodeProgress
  bool rotational_gusts = false;  ///< where it is windy
};

/// The memory of an environment's aircraft, in tiles of blocks. What is worked on together lies
/// together: per block its physical columns, task columns, last actions, drawn plants and episode
/// returns (float32), control steps, numbers of episodes and progress (int32), and the delay line
/// (float32), each as long as the block's stride.
class EnvStorage {
 public:
  /// Everything is zero. `requested_tile_size` is rounded up to a multiple of 32. Both numbers of
  /// aircraft are at least 1.
  EnvStorage(int num_aircraft, int requested_tile_size, const EnvColumns& columns);

  int num_aircraft() const { return num_aircraft_; }
  int num_tiles() const { return num_tiles_; }
  int tile_begin(int tile) const { return tile * tile_size_; }
  int tile_count(int tile) const;
  std::size_t num_blocks() const { return num_blocks_; }

  /// The block that begins at, or holds from there on, the tile's aircraft `begin`.
  EnvBlock BlockAt(int tile, int begin);
  /// The aircraft and those of its block that follow. Throws Error if there is no such aircraft.
  EnvBlock BlockFrom(int aircraft);
  /// Calls visit(block) for every block.
  template <typename Visit>
  void ForEachBlock(const Visit& visit) {
    for (int tile = 0; tile < num_tiles_; ++tile) {
      for (int begin = 0; begin < tile_count(tile); begin += kAircraftPerBlock) {
        visit(BlockAt(tile, begin));
      }
    }
  }
  /// Where the block that follows `block` lies; nowhere after the last.
  MemoryAhead MemoryAfter(const EnvBlock& block) const;

  /// Mutable 32-bit words of one aircraft.
  std::size_t words_per_aircraft() const;
  void Save(int aircraft, std::uint32_t* words);
  void Restore(int aircraft, const std::uint32_t* words);

  /// Gives the lanes beyond the block's last aircraft copies of its first, so that kernels meet
  /// only sound states there.
  void FillPadding(const EnvBlock& block);

 private:
  /// Columns of float32, and after them those of int32.
  int float_columns() const;
  int int_columns() const;
  void* WordAt(const EnvBlock& block, std::size_t index) const;

  int num_aircraft_;
  EnvColumns columns_;
  int flight_columns_;
  int tile_size_ = 0;
  int num_tiles_ = 0;
  int blocks_per_tile_ = 0;
  std::size_t stride_ = 0;  // of a block's columns
  std::size_t num_blocks_ = 0;
  std::size_t block_bytes_ = 0;
  LargeMemory memory_;
  /// DelayLine::newest by block. No part of the aircraft's state: words come by age.
  std::vector<NewestSlots> newest_slots_;
};

}  // namespace skein
