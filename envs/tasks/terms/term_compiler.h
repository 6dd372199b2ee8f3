// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/aircraft/aircraft.h"
#include "envs/tasks/terms/term_columns.h"
#include "envs/tasks/terms/term_program.h"
#include "envs/tasks/terms/term_task_config.h"

namespace skein {

/// What a task's terms become: programs for what leads a row of observations, for the normalised
/// errors of the first three targets, and for rewards and ends.
struct TermPrograms {
  TermProgram observed, errors, reward;
};

/// Throws Error if the terms need more registers than there are.
TermPrograms CompileTerms(const TermTaskConfig& config, const TermColumns& columns,
                          const ReferenceUnits& units);

}  // namespace skein
