// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tests/train/small_config.h"
#include "train/policy/recurrent_policy.h"

namespace skein {

/// A fresh policy of the Control task that holds an action for four control steps.
inline std::shared_ptr<const RecurrentPolicy> SmallLowLevelPolicy(std::uint64_t seed = 11) {
  return std::make_shared<const RecurrentPolicy>(
      RecurrentPolicy::Untrained(SmallConfig().network, 22, 4, seed, /*action_repeat=*/4));
}

/// SmallConfig for a high-level policy of Tracking over SmallLowLevelPolicy.
inline TrainConfig SmallHighLevelConfig() {
  TrainConfig config = SmallConfig();
  config.env.task = "tracking";
  config.env.action_repeat = 10;
  config.low_level = SmallLowLevelPolicy();
  config.total_steps = 96 * 16 * 10 * 3;
  return config;
}

}  // namespace skein
