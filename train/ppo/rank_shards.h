// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/ppo/shards.h"
#include "train/ppo/train_config.h"
#include "train/ranks/ranks.h"

namespace skein {

/// The shards of this rank, equally many as of every other. Throws Error, which says how many
/// shards so many ranks need, if the configuration's cannot be dealt out so.
ShardRange ShardsOfRank(const TrainConfig& config, const Ranks& ranks);

/// As many shards as a training by `ranks` is given unless it says how many: 32, or more if there
/// are more ranks, or the most that the configuration allows. Up to 32 ranks get the same training.
int ShardsForRanks(const TrainConfig& config, int ranks);

}  // namespace skein
