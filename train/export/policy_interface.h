// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "envs/env_config.h"
#include "train/policy/policy_parameters.h"

namespace skein {

/// What a number that goes into a policy or comes out of it stands for: `scale` times the number
/// plus `offset`, in the unit that the name ends in.
struct PolicyNumber {
  std::string name;
  double scale = 1;
  double offset = 0;
};

/// What flies a policy elsewhere has to know of it besides its network.
struct PolicyInterface {
  EnvConfig env;  ///< task, aircraft, control interval: as far as the policy depends on them
  int action_repeat = 1;
  std::vector<PolicyNumber> observations, actions;

  /// Time between two policy steps, s.
  double policy_step_s() const { return env.control_interval_s * action_repeat; }
};

/// `terms` is the task of the policy's task file; null for a built-in task. Throws Error that
/// begins with `who` if the policy does not say for which task it was made, or names a task, an
/// aircraft or a setting that this program does not know.
PolicyInterface DescribeInterface(const RecurrentPolicy::Parameters& policy,
                                  const std::shared_ptr<const TermTaskConfig>& terms,
                                  const std::string& who);

/// The same as texts, for formats that keep texts beside a network: task, aircraft, rates; names,
/// scales and offsets as JSON arrays.
std::map<std::string, std::string> InterfaceMetadata(const PolicyInterface& interface);

}  // namespace skein
