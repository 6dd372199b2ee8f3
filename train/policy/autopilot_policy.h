// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "envs/env_config.h"
#include "envs/policy.h"

namespace skein {

/// A traditional autopilot of the Control task (envs/autopilot/autopilot.h) that flies for a
/// high-level policy, with what it takes to make it again.
class AutopilotPolicy final : public Policy {
 public:
  /// By the name of an AutopilotVariant. Throws Error on an unknown one, or if it has no gains for
  /// the environment's aircraft.
  AutopilotPolicy(const std::string& variant, const EnvConfig& env);

  const std::string& variant() const { return variant_; }
  double control_interval_s() const { return control_interval_s_; }

  int observation_size() const override { return autopilot_->observation_size(); }
  int action_size() const override { return autopilot_->action_size(); }
  int state_size() const override { return autopilot_->state_size(); }
  int action_repeat() const override { return autopilot_->action_repeat(); }
  void Act(int count, const float* observation, float* state, float* action) const override {
    autopilot_->Act(count, observation, state, action);
  }

 private:
  std::string variant_;
  double control_interval_s_;
  std::unique_ptr<const Policy> autopilot_;
};

}  // namespace skein
