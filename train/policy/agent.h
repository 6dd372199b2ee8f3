// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "envs/policy.h"
#include "envs/vec_env.h"
#include "train/policy/recurrent_policy.h"

namespace skein {

/// Who is evaluated: a pilot, perhaps with chance in what it does. Immutable, cheap to copy, and
/// safe to use from several threads.
class Agent {
 public:
  /// Flies as `pilot` decides.
  static Agent Of(std::shared_ptr<const Policy> pilot);
  /// A policy with its mean action.
  static Agent MeanOf(const RecurrentPolicy& policy);
  /// A policy with actions drawn from its distribution.
  static Agent SamplingFrom(const RecurrentPolicy& policy);
  /// Uniform in [-1, 1] whatever it observes, drawn anew every `action_repeat` control steps.
  static Agent Random(int action_repeat);
  /// Every command zero: sticks centred, throttle in the middle.
  static Agent Zero();

  /// As of Policy::EnvironmentFor.
  EnvConfig EnvironmentFor(const EnvConfig& env) const { return pilot_->EnvironmentFor(env); }
  int state_size() const { return pilot_->state_size(); }
  /// What flies when it is a high-level policy; null if it flies itself.
  std::shared_ptr<const Policy> low_level() const;

  /// Throws Error that says why not unless `env` is what it was made for, in sizes and meaning.
  void CheckFits(const VecEnv& env) const;

  /// Whose policy step it is: what chance depends on.
  struct Turn {
    std::uint64_t seed = 0;
    std::uint32_t first_aircraft = 0;
    std::uint32_t policy_step = 0;
  };

  /// One policy step for `count` aircraft, `turn.first_aircraft` and those that follow: rows as of
  /// Policy::Act. Actions may lie beyond [-1, 1].
  void Act(const Turn& turn, int count, const float* observation, float* state,
           float* action) const;

 private:
  enum class Sampling { kNone, kNormal, kUniform };

  Agent(std::shared_ptr<const Policy> pilot, Sampling sampling);
  Agent(const RecurrentPolicy& policy, Sampling sampling);

  std::shared_ptr<const Policy> pilot_;
  std::shared_ptr<const RecurrentPolicy> policy_;  ///< the pilot, if it is a policy
  Sampling sampling_;
};

}  // namespace skein
