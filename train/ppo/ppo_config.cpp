// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/ppo_config.h"

#include <cstdint>
#include <string>

#include "base/error.h"

namespace skein {

void Validate(const PpoConfig& config) {
  const auto require_positive = [](const char* key, int value) {
    if (value > 0) return;
    throw Error("configuration: ppo." + std::string(key) + " = " + std::to_string(value) +
                "; it must be positive");
  };
  require_positive("num_aircraft", config.num_aircraft);
  require_positive("rollout_steps", config.rollout_steps);
  require_positive("chunk_length", config.chunk_length);
  require_positive("minibatches", config.minibatches);
  if (config.rollout_steps % config.chunk_length != 0) {
    throw Error("configuration: ppo.rollout_steps = " + std::to_string(config.rollout_steps) +
                " is not a multiple of ppo.chunk_length = " + std::to_string(config.chunk_length));
  }
  const std::int64_t chunks =
      static_cast<std::int64_t>(config.num_aircraft) * (config.rollout_steps / config.chunk_length);
  if (config.minibatches > chunks) {
    throw Error("configuration: ppo.minibatches = " + std::to_string(config.minibatches) +
                " is more than the " + std::to_string(chunks) + " chunks of a rollout");
  }
}

}  // namespace skein
