// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "base/worker_pool.h"
#include "envs/actions.h"
#include "envs/env_config.h"
#include "envs/state/state.h"
#include "envs/tasks/termination.h"
#include "train/policy/agent.h"
#include "train/policy/evaluate.h"

namespace skein {

/// The end of one control step.
struct RecordedStep {
  std::array<float, kNumRecordedColumns> state{};  ///< envs/state/state.h
  std::vector<float> action;  ///< the policy's, held during the step, clipped to [-1, 1]
  /// Stick commands, what enters the flight control system, clipped to [-1, 1]: the action, or the
  /// low-level policy's.
  std::array<float, kActionSize> stick{};
  /// Of a hierarchy: the pitch, rad, yaw, rad, and true airspeed, ft/s, that the low-level policy
  /// is to reach (LowLevelFlight::SetTargets).
  std::vector<float> command;
  std::vector<float> target;    ///< Task::target_quantities: the one that was flown to
  float reward = 0;             ///< of the step, terminal reward included
  bool reaches_target = false;  ///< the target counts as reached from this step on
  Termination termination = Termination::kNone;
};

/// One whole episode.
struct RecordedFlight {
  std::array<float, kNumRecordedColumns> initial_state{};
  std::vector<float> target;  ///< Task::target_quantities, at the start
  std::vector<RecordedStep> steps;
  /// Row-major [policy step][observation_size], noise included: what the agent saw. Control step k
  /// belongs to policy step k / action_repeat.
  std::vector<float> observations;
};

/// The first `count` episodes (all, if there are fewer) of Evaluate with the same arguments, flown
/// again control step by control step: bit-identical to what was evaluated, whatever the threads.
/// Incomplete if the pool is asked to stop.
std::vector<RecordedFlight> RecordFlights(const Agent& agent, const EnvConfig& env,
                                          const EvaluationOptions& options, int count,
                                          WorkerPool& pool);

}  // namespace skein
