// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "envs/actions.h"
#include "envs/policy.h"
#include "envs/tasks/observation.h"

namespace skein {

/// A gentle pilot of the Control task: proportional in pitch and speed, rolling towards the yaw
/// that is asked for. It remembers how often it has decided, and the pitch errors that it has seen,
/// which it adds up and flies by.
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
      const float* const seen = observation + i * kObservationSize;
      float* const memory = state + i * 2;
      memory[0] += 1;
      memory[1] += seen[0];
      const float roll = std::clamp(seen[1], -0.5f, 0.5f) - seen[4];
      float* const stick = action + i * kActionSize;
      stick[0] = 0.2f + 4 * seen[2];
      stick[1] = 0.8f * seen[0] + 0.05f * memory[1];
      stick[2] = 0.6f * roll;
      stick[3] = 0.001f * memory[0];
    }
  }

 private:
  int action_repeat_, observation_size_, action_size_;
};

}  // namespace skein
