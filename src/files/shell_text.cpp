// SPDX-License-Identifier: Apache-2.0
#include "src/files/shell_text.h"

#include <cerrno>
#include <filesystem>

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

std::string ProgramWord() {
  const std::filesystem::path name = program_invocation_name;
  const bool is_path = name.has_parent_path() && name.filename() == "skein";
  return is_path ? ShellWord(name.string()) : "skein";
}

}  // namespace skein
