// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "envs/policy.h"
#include "envs/vec_env.h"
#include "train/policy/recurrent_policy.h"

namespace skein {

/// What is evaluated: a policy, its actions as they are or drawn at random. Immutable, cheap to
/// copy, and safe to use from several threads.
class Agent {
 public:
  /// The actions of `policy`, of a RecurrentPolicy the mean ones.
  static Agent Of(std::shared_ptr<const Policy> policy);
  /// The mean actions of `policy`.
  static Agent MeanOf(const RecurrentPolicy& policy);
  /// Actions drawn from the distribution of `policy`.
  static Agent SamplingFrom(const RecurrentPolicy& policy);
  /// Random actions: uniform in [-1, 1] whatever it observes, drawn anew every `action_repeat`
  /// control steps.
  static Agent Random(int action_repeat);
  /// Zero actions: stick and pedals centred, throttle in the middle.
  static Agent Zero();

  /// As of Policy::EnvironmentFor.
  EnvConfig EnvironmentFor(const EnvConfig& env) const { return policy_->EnvironmentFor(env); }
  /// Floats of memory per aircraft.
  int state_size() const { return policy_->state_size(); }
  /// What flies for it if it is a high-level policy; null if it flies itself.
  std::shared_ptr<const Policy> low_level() const;

  /// Throws Error that says why not unless `env` is what it was made for, in sizes and meaning, if
  /// not in its rate.
  void CheckFits(const VecEnv& env) const;

  /// Which policy step of which aircraft: what random numbers depend on.
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

  Agent(std::shared_ptr<const Policy> policy, Sampling sampling);
  Agent(const RecurrentPolicy& policy, Sampling sampling);

  std::shared_ptr<const Policy> policy_;
  std::shared_ptr<const RecurrentPolicy> recurrent_;  ///< the same, if it is one
  Sampling sampling_;
};

}  // namespace skein
