#pragma once

#include <memory>

#include "tests/train/small_config.h"
#include "train/policy/recurrent_policy.h"

namespace skein {

/// A fresh pilot of the Control task that decides every four control steps.
inline std::shared_ptr<const Policy> SmallController(std::uint64_t seed = 11) {
  return std::make_shared<const Policy>(
      Policy::Untrained(SmallConfig().network, 22, 4, seed, /*action_repeat=*/4));
}

/// SmallConfig for a planner of Tracking over SmallController.
inline TrainConfig SmallPlannerConfig() {
  TrainConfig config = SmallConfig();
  config.env.task = "tracking";
  config.env.action_repeat = 10;
  config.controller = SmallController();
  config.total_steps = 96 * 16 * 10 * 3;
  return config;
}

}  // namespace skein
