// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "envs/env_config.h"
#include "train/files/tensor_file.h"
#include "train/policy/stored_policy.h"

namespace skein {

/// The autopilot of the Control task (envs/autopilot/autopilot.h) as a low-level policy.
class AutopilotPolicy final : public StoredPolicy {
 public:
  /// By the name of an AutopilotVariant. Throws Error on an unknown one, or if it has no gains for
  /// the environment's aircraft.
  AutopilotPolicy(const std::string& variant, const EnvConfig& env);

  /// The autopilot in a file that Store wrote to; null if there is none. Throws Error, naming
  /// `path`, on one that is damaged.
  static std::shared_ptr<const AutopilotPolicy> Load(const TensorFile& file,
                                                     const std::string& path);

  const std::string& variant() const { return variant_; }
  double control_interval_s() const { return control_interval_s_; }

  int observation_size() const override { return autopilot_->observation_size(); }
  int action_size() const override { return autopilot_->action_size(); }
  int state_size() const override { return autopilot_->state_size(); }
  int action_repeat() const override { return autopilot_->action_repeat(); }
  /// Also throws where it has no gains.
  void CheckMadeFor(const EnvConfig& env, const std::string& who) const override;
  void Act(int count, const float* observation, float* state, float* action) const override {
    autopilot_->Act(count, observation, state, action);
  }

  void Store(TensorFile& file) const override;
  std::shared_ptr<const StoredPolicy> OnBackend(Backend backend) const override;
  double FlopsPerAction() const override { return 0; }

 private:
  std::string variant_;
  double control_interval_s_;
  std::shared_ptr<const Policy> autopilot_;
};

}  // namespace skein
