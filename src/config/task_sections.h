// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>

#include <string>

#include "envs/tasks/terms/term_task_config.h"

namespace skein {

// The sections of a task file (docs/reference/task-files.md). Each function reads one table of
// `source` into `task`, what stands earlier in this list before what stands later: terms may read
// terrain and targets. They throw Error with the line and the key.

void ReadTerrain(const toml::table& table, const std::string& source, TermTaskConfig* task);
void ReadTarget(const toml::table& table, const std::string& source, TermTaskConfig* task);
void ReadReward(const toml::table& table, const std::string& source, TermTaskConfig* task);
void ReadReached(const toml::table& table, const std::string& source, TermTaskConfig* task);
void ReadEnd(const toml::table& table, const std::string& source, TermTaskConfig* task);

}  // namespace skein
