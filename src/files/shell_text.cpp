// SPDX-License-Identifier: Apache-2.0
#include "src/files/shell_text.h"

namespace skein {

std::string SingleQuoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string ShellWord(const std::string& text) {
  const bool is_plain =
      text.find_first_not_of(
          "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789/._-+=:,@") ==
      std::string::npos;
  return is_plain && !text.empty() ? text : SingleQuoted(text);
}

}  // namespace skein
