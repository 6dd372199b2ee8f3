// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein {

/// The text without blanks, tabs and line breaks at its ends.
inline std::string Trimmed(const std::string& text) {
  constexpr const char* kBlanks = " \t\r\n";
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

}  // namespace skein
