// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "train/ppo/train_config.h"

namespace skein {

/// Throws Error, which names the weight of the reward or the reward of an end that is largest in
/// magnitude, if one of `rewards` is not finite or too large for float32 to sum and square: no
/// learning rate would help. Rewards of truncated episodes hold the critic's value: where `values`,
/// the critic's of the same steps, are no better, it is the critic that has exploded, which is for
/// the update to say.
void RequireUsableRewards(const TrainConfig& config, const std::vector<float>& rewards,
                          const std::vector<float>& values);

}  // namespace skein
