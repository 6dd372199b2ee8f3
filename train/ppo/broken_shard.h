// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "train/ppo/shards.h"
#include "train/ranks/ranks.h"

namespace skein {

/// The first shard of all ranks in which something is wrong, as ", first in shard 5 on rank 1
/// (node7)"; empty if no rank has one, or there is but one shard. `first_here` is this rank's, or
/// `shards.total`. Called on all ranks together.
std::string NameFirstBroken(const ShardRange& shards, int first_here, Ranks& ranks);

}  // namespace skein
