// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/shards.h"

#include <string>

#include "base/error.h"

namespace skein {

bool AreShardsPossible(int shards, int num_aircraft, int chunks_per_aircraft, int minibatches) {
  const bool is_power = shards > 0 && (shards & (shards - 1)) == 0;
  return is_power && num_aircraft % shards == 0 &&
         static_cast<long long>(num_aircraft / shards) * chunks_per_aircraft >= minibatches;
}

void ValidateShards(int shards, int num_aircraft, int chunks_per_aircraft, int minibatches) {
  if (AreShardsPossible(shards, num_aircraft, chunks_per_aircraft, minibatches)) return;
  std::string possible = "1";
  for (int power = 2; power <= num_aircraft / 2 + 1; power *= 2) {
    if (!AreShardsPossible(power, num_aircraft, chunks_per_aircraft, minibatches)) break;
    possible += ", " + std::to_string(power);
  }
  throw Error("configuration: learner.shards = " + std::to_string(shards) +
              " is not possible: a power of two is, that divides ppo.num_aircraft = " +
              std::to_string(num_aircraft) + " and leaves every shard a chunk of each of the " +
              std::to_string(minibatches) + " ppo.minibatches: " + possible);
}

}  // namespace skein
