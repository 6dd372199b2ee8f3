// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "envs/env_config.h"
#include "envs/policy.h"
#include "src/run/run_directory.h"

namespace skein {

/// A low-level policy that was asked for on the command line.
struct ChosenLowLevelPolicy {
  std::shared_ptr<const Policy> pilot;  ///< null where none flies
  std::string description;              ///< a line for people
};

/// What flies for a high-level policy of the environment's task: the policy that `option` names (a
/// run of task control, or a file of one), an autopilot ("autopilot", or "autopilot:VARIANT"), or
/// nothing if it is empty. Throws Error if the task needs a low-level policy and none is named, if
/// it knows none, or if what is named cannot fly as one.
ChosenLowLevelPolicy ChooseLowLevelPolicy(const EnvConfig& env, const std::string& option);

/// What the high-level policy of the run in `directory` began with; null if `task` is not planned.
/// Throws Error if it cannot be read.
std::shared_ptr<const Policy> LowLevelPolicyOfRun(const RunDirectory& directory,
                                                  const std::string& task);

}  // namespace skein
