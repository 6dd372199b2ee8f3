// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "envs/kernels/plant_kernel.h"
#include "envs/state/state.h"

namespace skein::bench {

/// F-16s at random flight conditions of the whole envelope, tile behind tile in memory: aircraft of
/// one vector read different table cells, as in training. Flights without control leave the tables
/// sooner or later: Restart.
class Flock {
 public:
  explicit Flock(int count);

  int count() const { return count_; }
  int tiles() const;
  Tile At(int tile);
  /// The memory of the tile after `tile`; empty for the last.
  MemoryAhead Behind(int tile);
  void Restart();

 private:
  static constexpr int kTileSize = 128;  // stays in the innermost caches
  std::size_t tile_floats() const { return stride_ * kNumColumns; }

  int count_;
  std::size_t stride_;
  std::vector<float> values_, start_;
  float* base_ = nullptr;  // the first boundary of a cache line in values_
};

/// The F-16 as the kernels have it, made once.
const KernelAircraft& KernelF16();

}  // namespace skein::bench
