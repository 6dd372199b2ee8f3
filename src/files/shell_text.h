// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein {

/// `text` as one word of a POSIX shell, in single quotes.
std::string SingleQuoted(const std::string& text);

/// The same, without quotes where they are not needed.
std::string ShellWord(const std::string& text);

/// What starts this program again, as ShellWord, for hints that can be copied: its path if it was
/// started by one, else `skein`.
std::string ProgramWord();

}  // namespace skein
