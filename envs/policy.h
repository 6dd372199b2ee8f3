// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "envs/env_config.h"

namespace skein {

/// What chooses the actions of aircraft by their observations: a trained policy, an autopilot.
/// Immutable, and safe to use from several threads: its memory of each aircraft lies with the
/// caller.
class Policy {
 public:
  virtual ~Policy() = default;

  /// Numbers that it observes of each aircraft; 0: whatever there are, as it looks at none.
  virtual int observation_size() const = 0;
  virtual int action_size() const = 0;    ///< numbers of its actions for each
  virtual int state_size() const = 0;     ///< floats of memory per aircraft
  virtual int action_repeat() const = 0;  ///< control steps for which its actions are to be held

  /// `env` with the choices that belong to the policy and not to the episodes: for how long it
  /// holds an action, in which axes it observes Tracking's target, whether a high-level policy
  /// observes means.
  virtual EnvConfig EnvironmentFor(const EnvConfig& env) const {
    EnvConfig own = env;
    own.action_repeat = action_repeat();
    return own;
  }

  /// Throws Error that begins with `who` and names the first difference if it was made for another
  /// task or environment than `env`, as far as it knows.
  virtual void CheckMadeFor(const EnvConfig& /*env*/, const std::string& /*who*/) const {}

  /// One policy step for `count` aircraft: reads observation [count][observation_size], updates
  /// state [count][state_size], in which a row of zeros is the beginning of an episode, and writes
  /// action [count][action_size]. Every aircraft's action depends on its own rows alone.
  virtual void Act(int count, const float* observation, float* state, float* action) const = 0;
};

}  // namespace skein
