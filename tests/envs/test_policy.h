// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "envs/actions.h"
#include "envs/policy.h"
#include "envs/tasks/observation.h"

namespace skein {

/// A gentle policy for the Control task: proportional in pitch and speed, rolling towards the yaw
/// that is asked for. Its state is the number of its policy steps and the sum of the pitch errors
/// that it has observed, by which it acts, too.
class TestPolicy : public Policy {
 public:
  explicit TestPolicy(int action_repeat, int observation_size = kObservationSize,
                      int action_size = kActionSize)
      : action_repeat_(action_repeat),
        observation_size_(observation_size),
        action_size_(action_size) {}

  int observation_size() const override { return observation_size_; }
  int action_size() const override { return action_size_; }
  int state_size() const override { return 2; }
  int action_repeat() const override { return action_repeat_; }

  void Act(int count, const float* observation, float* state, float* action) const override {
    for (int i = 0; i < count; ++i) {
      const float* const observed = observation + i * kObservationSize;
      float* const memory = state + i * 2;
      memory[0] += 1;
      memory[1] += observed[0];
      const float roll = std::clamp(observed[1], -0.5f, 0.5f) - observed[4];
      float* const command = action + i * kActionSize;
      command[0] = 0.2f + 4 * observed[2];
      command[1] = 0.8f * observed[0] + 0.05f * memory[1];
      command[2] = 0.6f * roll;
      command[3] = 0.001f * memory[0];
    }
  }

 private:
  int action_repeat_, observation_size_, action_size_;
};

}  // namespace skein
