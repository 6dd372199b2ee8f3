// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/env_config.h"

namespace skein {

/// Something that flies aircraft by what they observe: a trained policy, an autopilot. Immutable,
/// and safe to use from several threads: what it remembers of each aircraft lies with the caller.
class Policy {
 public:
  virtual ~Policy() = default;

  virtual int observation_size() const = 0;
  virtual int action_size() const = 0;
  virtual int state_size() const = 0;     ///< floats of memory per aircraft
  virtual int action_repeat() const = 0;  ///< control steps for which it means an action to be held

  /// The environment as it observes `env` and acts in it, where a choice belongs to the pilot and
  /// not to the episodes: how long it holds an action, in which axes it is shown Tracking's target,
  /// whether a high-level policy sees means.
  virtual EnvConfig EnvironmentFor(const EnvConfig& env) const {
    EnvConfig own = env;
    own.action_repeat = action_repeat();
    return own;
  }

  /// One policy step for `count` aircraft: reads observation [count][observation_size], updates
  /// state [count][state_size], in which a row of zeros is the beginning of an episode, and writes
  /// action [count][action_size]. Every aircraft's action depends on its own rows alone.
  virtual void Act(int count, const float* observation, float* state, float* action) const = 0;
};

}  // namespace skein
