// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "envs/aircraft/aircraft.h"
#include "envs/tasks/target_limits.h"
#include "envs/tasks/task.h"
#include "envs/tasks/terms/term_task_config.h"

namespace skein {

/// A task that is made of terms. They are compiled once, into programs of vector operations
/// (envs/tasks/terms/term_program.h). Throws Error if they are too many, or too little is observed.
std::unique_ptr<Task> MakeTermTask(const std::shared_ptr<const TermTaskConfig>& config,
                                   const Aircraft& aircraft, const TargetLimits& limits);

}  // namespace skein
