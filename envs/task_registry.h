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

/// Whether the task is trained by a high-level policy over a low-level policy, not by flying
/// itself.
bool IsHierarchical(const std::string& task);

/// Throws Error on an unknown name; the message lists the known ones.
std::unique_ptr<Task> MakeTask(const EnvConfig& config);

}  // namespace skein
