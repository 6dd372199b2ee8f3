// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "envs/env_config.h"

namespace skein {

/// The configuration assignments ("env.initial.altitude_min_ft=30000") that put an environment
/// under `conditions`, each "NAME=LEVEL" as docs/reference/conditions.md describes them. Throws
/// Error on an unknown or repeated name and on a level that cannot be read, saying what would be
/// right.
std::vector<std::string> ConditionAssignments(const std::vector<std::string>& conditions);

/// What conditions an environment is under, for people: "f16 from 19000 to 20000 ft and 1000 to
/// 1200 ft/s; still air; noise 0.01".
std::string DescribeConditions(const EnvConfig& env);

/// The same of its evaluations, and what counts there: "...; drag rise and thrust growth; a target
/// counts after 1 s and is held for 8 s".
std::string DescribeEvaluation(const EnvConfig& env);

/// A condition and what its levels stand for, for people.
struct ConditionForm {
  const char* name;
  const char* level;  ///< what a level looks like
  const char* mild;
  const char* middle;
  const char* hard;
};

/// Every condition.
std::vector<ConditionForm> ConditionForms();

/// The help text of a command's option --condition.
std::string ConditionHelp();

}  // namespace skein
