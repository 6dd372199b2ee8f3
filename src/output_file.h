#pragma once

#include <string>

namespace skein {

/// Replaces the file at `path` by `text`, durably and whole or not at all (ReplaceFile); through a
/// symbolic link, the file it leads to. A device, a pipe or the program's own standard output is
/// written to directly. Throws Error (path, reason of the system).
void WriteFile(const std::string& path, const std::string& text);

/// Throws Error (path, reason) if WriteFile is sure to fail there: before the work whose result it
/// is to hold. An empty path stands for no file.
void CheckWritable(const std::string& path);

/// `name` with what file names had better not hold replaced by '-'.
std::string FileNamePart(const std::string& name);

/// The whole file, which may be a pipe. Throws Error if it cannot be read.
std::string ReadFile(const std::string& path);

}  // namespace skein
