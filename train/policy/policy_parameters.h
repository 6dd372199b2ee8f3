// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "train/files/tensor_file.h"
#include "train/network/backend.h"
#include "train/network/network.h"
#include "train/policy/recurrent_policy.h"

namespace skein {

/// What a RecurrentPolicy is made of.
struct RecurrentPolicy::Parameters {
  NetworkConfig config;
  NetworkShape shape;
  int action_repeat = 1;
  std::string task;       ///< what it was trained for; empty if unknown
  std::string task_file;  ///< text of the task file that it was trained for; empty without
  /// What else of it the policy cannot fly without (train/policy/policy_environment.h), as far as
  /// known.
  std::map<std::string, std::string> environment;
  std::shared_ptr<const StoredPolicy> low_level;  ///< of a high-level policy, else null
  std::vector<float> values;                      ///< the actor's flat parameters
};

/// Writes the actor's description and parameters into `file`, one tensor "actor/<name>" per slice,
/// and its low-level policy (train/policy/low_level_file.h).
void StorePolicy(const RecurrentPolicy::Parameters& parameters, TensorFile& file);

/// The actor in a file that StorePolicy wrote to. Throws Error, naming `path`, if there is none.
std::shared_ptr<const RecurrentPolicy::Parameters> LoadPolicy(TensorFile file,
                                                              const std::string& path);

}  // namespace skein
