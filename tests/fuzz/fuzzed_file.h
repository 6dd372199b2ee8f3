// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein {

/// The path where a reader that wants one finds a file of these bytes, until the next call.
const std::string& InFile(const std::string& bytes, const char* extension = "");

}  // namespace skein
