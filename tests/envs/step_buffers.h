// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "envs/actions.h"
#include "envs/tasks/observation.h"
#include "envs/vec_env.h"

namespace skein {

/// What a tile of `count` aircraft is given and gives in a step of its environment.
struct StepBuffers {
  explicit StepBuffers(int count, int actions = kActionSize)
      : observation(static_cast<std::size_t>(count) * kObservationSize),
        final_observation(observation.size()),
        action(static_cast<std::size_t>(count) * static_cast<std::size_t>(actions)),
        reward(static_cast<std::size_t>(count)),
        episode_return(reward.size()),
        termination(reward.size()),
        episode_steps(reward.size()) {}

  StepOutput output() {
    return {reward.data(), termination.data(), episode_return.data(), episode_steps.data(),
            final_observation.data()};
  }

  std::vector<float> observation, final_observation, action, reward, episode_return;
  std::vector<std::uint8_t> termination;
  std::vector<std::int32_t> episode_steps;
};

}  // namespace skein
