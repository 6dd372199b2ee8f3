// SPDX-License-Identifier: Apache-2.0
#include "bench/flock.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "envs/aircraft/f16.h"

namespace skein::bench {
namespace {

constexpr std::size_t kCacheLineFloats = 16;

}  // namespace

Flock::Flock(int count) : count_(count), stride_(TileStride(std::min(count, kTileSize))) {
  values_.resize(static_cast<std::size_t>(tiles()) * tile_floats() + kCacheLineFloats);
  base_ = values_.data();
  while (reinterpret_cast<std::uintptr_t>(base_) % (kCacheLineFloats * sizeof(float)) != 0) ++base_;
  std::mt19937 random(1);
  const auto uniform = [&](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
  };
  for (int t = 0; t < tiles(); ++t) {
    const Tile tile = At(t);
    for (std::size_t i = 0; i < stride_; ++i) {
      const float speed = uniform(400, 1000), alpha = uniform(-0.05f, 0.35f);
      tile[kU][i] = speed * std::cos(alpha);
      tile[kV][i] = uniform(-30, 30);
      tile[kW][i] = speed * std::sin(alpha);
      for (const int rate : {kP, kQ, kR}) tile[rate][i] = uniform(-0.1f, 0.1f);
      tile[kDown][i] = -uniform(5000, 40000);
      const float bank = uniform(-0.7f, 0.7f);
      tile[kQ0][i] = std::cos(bank / 2);
      tile[kQx][i] = std::sin(bank / 2);
      tile[kPower][i] = uniform(0, 100);
      tile[kPowerCommand][i] = uniform(0, 100);
      tile[kElevator][i] = uniform(-5, 5);
      tile[kAileron][i] = uniform(-5, 5);
      tile[kRudder][i] = uniform(-5, 5);
      tile[kLeadingEdgeFlap][i] = uniform(0, 25);
    }
  }
  start_ = values_;
}

int Flock::tiles() const { return (count_ + kTileSize - 1) / kTileSize; }

Tile Flock::At(int tile) {
  return {base_ + static_cast<std::size_t>(tile) * tile_floats(), stride_,
          std::min(kTileSize, count_ - tile * kTileSize)};
}

MemoryAhead Flock::Behind(int tile) {
  if (tile + 1 >= tiles()) return {};
  using Pointer = decltype(MemoryAhead::begin);
  return {reinterpret_cast<Pointer>(At(tile + 1).base), tile_floats() * sizeof(float)};
}

void Flock::Restart() { std::copy(start_.begin(), start_.end(), values_.begin()); }

const KernelAircraft& KernelF16() {
  static const auto aircraft = MakeKernelAircraft(F16(), AtmosphereModel::kStevensLewis);
  return *aircraft;
}

}  // namespace skein::bench
