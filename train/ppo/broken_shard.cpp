// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/broken_shard.h"

#include <algorithm>

#include "train/ranks/collectives.h"

namespace skein {

std::string NameFirstBroken(const ShardRange& shards, int first_here, Ranks& ranks) {
  int first = first_here;
  CombineOverRanks(ranks, 1, &first, [](int& mine, int theirs) { mine = std::min(mine, theirs); });
  if (shards.total == 1 || first == shards.total) return "";
  const std::string where = ", first in shard " + std::to_string(first);
  return ranks.count() == 1 ? where : where + " on " + ranks.Describe(first / shards.count);
}

}  // namespace skein
