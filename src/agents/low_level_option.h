// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "envs/env_config.h"
#include "train/policy/stored_policy.h"

namespace skein {

/// The low-level policy that the command line asks for.
struct ChosenLowLevelPolicy {
  std::shared_ptr<const StoredPolicy> policy;  ///< null where there is none
  std::string description;                     ///< a line for people
};

/// The low-level policy for the environment's task: the policy that `option` names (a run of task
/// control, or a policy file of it), an autopilot ("autopilot", or "autopilot:VARIANT"), or none if
/// it is empty. Throws UsageError if the task needs one and none is named, or the reverse;
/// ChoiceError if what is named cannot be one, and Error if it cannot be read.
ChosenLowLevelPolicy ChooseLowLevelPolicy(const EnvConfig& env, const std::string& option);

/// The same; if the task needs one and none is named, that of the high-level policy in `from`, a
/// policy file or checkpoint, unless that is empty or has none.
ChosenLowLevelPolicy ChooseLowLevelPolicy(const EnvConfig& env, const std::string& option,
                                          const std::string& from);

}  // namespace skein
