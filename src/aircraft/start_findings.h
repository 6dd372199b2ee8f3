// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "envs/tuning/aircraft_findings.h"

namespace skein {

/// What is wrong with where episodes of `task` (a name, or a task file) begin if `aircraft` (a name
/// of envs/aircraft/registry.h, or a file) flies it, by the preset that serves the aircraft, or the
/// default one with the settings of its file. Errors: these settings are unknown or out of range;
/// level flight there is below stall speed, or cannot be. Warnings: it needs more thrust than there
/// is, or lies outside of tables; the settings leave out what the task needs. Throws Error on an
/// unknown task.
std::vector<Finding> CheckStart(const std::string& aircraft, const std::string& task);

}  // namespace skein
