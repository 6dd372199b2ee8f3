// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>

#include "train/export/policy_interface.h"
#include "train/policy/policy_parameters.h"

namespace skein {

/// A policy on its way into another format.
struct ExportedPolicy {
  std::string name;  ///< of functions and models, an identifier; by default the task
  std::shared_ptr<const RecurrentPolicy::Parameters> policy;
  PolicyInterface interface;
  std::map<std::string, std::string> metadata;  ///< InterfaceMetadata, and what wrote it: "version"

  NetworkLayout layout() const { return NetworkLayout(policy->shape); }
  const float* values(std::int64_t offset) const { return policy->values.data() + offset; }
};

/// Throws Error as DescribeInterface. `version` is what is said of the program; `terms` is the task
/// of the policy's task file, null for a built-in task.
ExportedPolicy PrepareExport(const RecurrentPolicy& policy, const std::string& who,
                             const std::string& version,
                             const std::shared_ptr<const TermTaskConfig>& terms = nullptr);

}  // namespace skein
