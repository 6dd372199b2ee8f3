// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "envs/actions.h"
#include "envs/step_memory.h"
#include "envs/tasks/observation.h"
#include "envs/vec_env.h"

namespace skein {

/// What a tile of `count` aircraft is given and gives in a step of its environment.
struct StepBuffers : StepMemory {
  explicit StepBuffers(int count, int actions = kActionSize)
      : StepMemory(count, {kObservationSize}),
        observation(final_observation.size()),
        action(static_cast<std::size_t>(count) * static_cast<std::size_t>(actions)) {}

  std::vector<float> observation, action;
};

}  // namespace skein
