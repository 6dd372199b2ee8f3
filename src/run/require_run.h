// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein {

/// Throws ChoiceError unless `path` is the directory of a run.
void RequireRun(const std::string& path);

}  // namespace skein
