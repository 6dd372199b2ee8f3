// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein {

/// Whether there is no control character in it, which would break a line.
bool IsOneLine(const std::string& text);

/// `text` as valid UTF-8 in one line: U+FFFD in place of what is not UTF-8, and blanks in place of
/// control characters. Names and what files say may hold anything.
std::string PlainLine(const std::string& text);

}  // namespace skein
