// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "envs/env_config.h"
#include "envs/tasks/task.h"

namespace skein {

/// Names that EnvConfig::task may have.
std::vector<std::string> TaskNames();

/// Whether a high-level policy over a low-level policy can fly the task.
bool CanBeHierarchical(const std::string& task);

/// Whether such a policy is to fly `config`'s task, and not one that gives stick commands itself
/// (TrackingConfig::acts_directly).
bool NeedsLowLevel(const EnvConfig& config);

/// Throws Error on an unknown name; the message lists the known ones.
std::unique_ptr<Task> MakeTask(const EnvConfig& config);

}  // namespace skein
