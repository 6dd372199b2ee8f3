#pragma once

#include <string>

namespace skein {

/// Replaces the file at `path` by `text`: temporary file beside it, fsync, rename, fsync of the
/// directory. A device or pipe is written to directly. Throws Error (path, reason of the system);
/// an existing file is then untouched.
void WriteFile(const std::string& path, const std::string& text);

/// The whole file. Throws Error if it cannot be read.
std::string ReadFile(const std::string& path);

/// "No space left on device" and the like for the current errno.
std::string SystemReason();

}  // namespace skein
