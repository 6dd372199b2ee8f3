// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/minibatches.h"

#include <numeric>
#include <utility>

#include "simd/random.h"

namespace skein {
namespace {

/// Where a shard's number begins in the word that holds the epoch's, too.
constexpr int kShardShift = 16;

/// A permutation of [0, count): Fisher and Yates.
std::vector<std::int64_t> Shuffled(std::int64_t count, const simd::RandomKey& key) {
  std::vector<std::int64_t> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), std::int64_t{0});
  simd::RandomStream random(key);
  for (std::int64_t i = count - 1; i > 0; --i) {
    const auto other = static_cast<std::int64_t>(random.Uniform() * static_cast<double>(i + 1));
    std::swap(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(other)]);
  }
  return order;
}

}  // namespace

Minibatches::Minibatches(const Rollout& rollout, int minibatches, std::uint64_t seed,
                         std::uint64_t iteration, int epoch)
    : minibatches_(minibatches) {
  const int aircraft = rollout.shard_aircraft();
  for (int shard = 0; shard < rollout.shards.count; ++shard) {
    const auto number = static_cast<std::uint32_t>(rollout.shards.first + shard);
    std::vector<std::int64_t> order = Shuffled(
        static_cast<std::int64_t>(rollout.chunks()) * aircraft,
        {seed, static_cast<std::uint32_t>(iteration), static_cast<std::uint32_t>(iteration >> 32),
         static_cast<std::uint32_t>(epoch) | number << kShardShift, simd::RandomPurpose::kShuffle});
    for (std::int64_t& chunk : order) {
      chunk = chunk / aircraft * rollout.aircraft + shard * aircraft + chunk % aircraft;
    }
    order_.push_back(std::move(order));
  }
}

std::vector<Chunks> Minibatches::At(int index) const {
  std::vector<Chunks> chunks;
  for (const std::vector<std::int64_t>& order : order_) {
    const auto count = static_cast<std::int64_t>(order.size());
    const std::int64_t begin = count * index / minibatches_;
    const std::int64_t end = count * (index + 1) / minibatches_;
    chunks.push_back({order.data() + begin, static_cast<int>(end - begin)});
  }
  return chunks;
}

}  // namespace skein
