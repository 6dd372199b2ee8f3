// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/minibatches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "tests/tolerance.h"

namespace skein {
namespace {

/// Of 24 aircraft, 4 chunks each.
Rollout SmallRollout(const ShardRange& shards) {
  PpoConfig config;
  config.num_aircraft = 24 / shards.total * shards.count;
  config.rollout_steps = 32;
  config.minibatches = 5;
  return Rollout(config, 2, 1, 1, 0, shards);
}

TEST(MinibatchesTest, EveryChunkIsVisitedOnceAnEpochAndEveryShardAlike) {
  for (const int shards : {1, 2, 4}) {
    const Rollout rollout = SmallRollout({shards, 0, shards});
    const Minibatches minibatches(rollout, 5, 7, 2, 1);
    std::multiset<std::int64_t> visited;
    for (int k = 0; k < 5; ++k) {
      const std::vector<Chunks> parts = minibatches.At(k);
      ASSERT_EQ(static_cast<int>(parts.size()), shards);
      for (int shard = 0; shard < shards; ++shard) {
        EXPECT_EQ(parts[shard].count, parts[0].count);
        for (int i = 0; i < parts[shard].count; ++i) {
          const std::int64_t chunk = parts[shard].first[i];
          EXPECT_EQ(chunk % 24 / (24 / shards), shard) << "an aircraft of another shard";
          visited.insert(chunk);
        }
      }
    }
    EXPECT_EQ(visited.size(), 24u * 4);
    EXPECT_EQ(std::set<std::int64_t>(visited.begin(), visited.end()).size(), 24u * 4);
  }
}

TEST(MinibatchesTest, AShardsChunksDoNotDependOnWhichOthersAreComputedHere) {
  const Minibatches all(SmallRollout({4, 0, 4}), 5, 7, 2, 1);
  const Minibatches last(SmallRollout({4, 2, 2}), 5, 7, 2, 1);
  std::set<std::vector<std::int64_t>> orders;
  for (int k = 0; k < 5; ++k) {
    for (int shard = 2; shard < 4; ++shard) {
      const Chunks expected = all.At(k)[shard], chunks = last.At(k)[shard - 2];
      ASSERT_EQ(chunks.count, expected.count);
      std::vector<std::int64_t> order;
      for (int i = 0; i < chunks.count; ++i) {
        // Numbered among the aircraft that are computed here, of which there are half as many.
        EXPECT_EQ(chunks.first[i] / 12, expected.first[i] / 24);
        EXPECT_EQ(chunks.first[i] % 12, expected.first[i] % 24 - 12);
        order.push_back(chunks.first[i] / 12 * 6 + chunks.first[i] % 6);
      }
      orders.insert(order);
    }
  }
  EXPECT_EQ(orders.size(), 10u) << "every shard is shuffled by itself";
}

/// The order in which an epoch visits the chunks of one shard.
std::vector<std::int64_t> OrderOf(std::uint64_t seed, std::uint64_t iteration, int epoch) {
  const Minibatches minibatches(SmallRollout({1, 0, 1}), 1, seed, iteration, epoch);
  const Chunks chunks = minibatches.At(0)[0];
  return {chunks.first, chunks.first + chunks.count};
}

TEST(MinibatchesTest, EverySeedIterationAndEpochShufflesAnew) {
  constexpr std::uint64_t kUpperHalf = std::uint64_t{1} << 32;
  const std::set<std::vector<std::int64_t>> orders{OrderOf(7, 2, 1),
                                                   OrderOf(8, 2, 1),
                                                   OrderOf(7 + kUpperHalf, 2, 1),
                                                   OrderOf(7, 3, 1),
                                                   OrderOf(7, 2 + kUpperHalf, 1),
                                                   OrderOf(7, 2, 0),
                                                   OrderOf(7, 2, 2)};
  EXPECT_EQ(orders.size(), 7u);
  EXPECT_EQ(OrderOf(7, 2, 1), OrderOf(7, 2, 1)) << "and nothing else does";
}

TEST(MinibatchesTest, EveryOrderIsAsLikelyAsAnyOther) {
  constexpr std::size_t kChunks = 24 * 4, kFirst = kChunks / 4;
  constexpr std::uint64_t kOrders = 4000;
  std::vector<int> in_first(kChunks, 0);
  int in_place = 0;
  for (std::uint64_t iteration = 0; iteration < kOrders; ++iteration) {
    const std::vector<std::int64_t> order = OrderOf(7, iteration, 0);
    for (std::size_t i = 0; i < kChunks; ++i) {
      in_first[static_cast<std::size_t>(order[i])] += i < kFirst;
      in_place += order[i] == static_cast<std::int64_t>(i);
    }
  }
  constexpr double kShare = 0.25;
  for (const int count : in_first) {
    EXPECT_NEAR(count, kShare * kOrders, kStandardErrors * std::sqrt(kShare * 0.75 * kOrders));
  }
  // Of any number of chunks one stays where it was, on average, with a variance of one.
  EXPECT_NEAR(in_place, kOrders, kStandardErrors * std::sqrt(kOrders));
}

}  // namespace
}  // namespace skein
