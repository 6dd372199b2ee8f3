// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/ppo/shards.h"
#include "train/ppo/train_config.h"
#include "train/ranks/ranks.h"

namespace skein {

/// The shards of this rank, equally many as of every other. Throws Error, which says how many
/// shards so many ranks need, if the configuration's cannot be dealt out so.
ShardRange ShardsOfRank(const TrainConfig& config, const Ranks& ranks);

/// As many shards as a training by several ranks has unless it is said how many: 32, or as many as
/// ranks if those are more, or the most that the configuration allows. So up to 32 ranks do the
/// same training.
int DefaultShards(const TrainConfig& config, int ranks);

}  // namespace skein
