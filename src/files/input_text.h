// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein {

/// As ReadFile, of an input that a command may read several times: what a pipe has said is kept, as
/// it says it once.
std::string ReadInputText(const std::string& path);

}  // namespace skein
