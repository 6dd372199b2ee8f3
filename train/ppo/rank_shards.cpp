// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/rank_shards.h"

#include <algorithm>
#include <string>

#include "base/error.h"

namespace skein {
namespace {

/// Enough for a few machines, and few enough for the default presets' aircraft.
constexpr int kShardsForRanks = 32;

/// The most shards that the configuration could have, up to `most`, a power of two.
int MostShards(const TrainConfig& config, int most) {
  const PpoConfig& ppo = config.ppo;
  while (most > 1 && !AreShardsPossible(most, ppo.num_aircraft,
                                        ppo.rollout_steps / ppo.chunk_length, ppo.minibatches)) {
    most /= 2;
  }
  return most;
}

}  // namespace

ShardRange ShardsOfRank(const TrainConfig& config, const Ranks& ranks) {
  const int shards = config.learner.shards;
  if (shards % ranks.count() == 0) {
    const int count = shards / ranks.count();
    return {shards, ranks.rank() * count, count};
  }
  const std::string most = std::to_string(MostShards(config, ranks.count()));
  const std::string wanted = std::to_string(ranks.count());
  throw Error("a training of learner.shards = " + std::to_string(shards) + " cannot be done by " +
              wanted + " ranks" +
              (shards > 1 ? ", by " + std::to_string(shards) + " at most" : "") +
              ": begin a new run with --set learner.shards=" + most +
              (most == wanted ? "" : " on as many, the most that its aircraft allow"));
}

int DefaultShards(const TrainConfig& config, int ranks) {
  return MostShards(config, std::max(kShardsForRanks, ranks));
}

}  // namespace skein
