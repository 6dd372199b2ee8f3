// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein {

/// An empty folder for files of the moment; gone with the object.
class ScratchFolder {
 public:
  /// Throws Error if it cannot be made.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  /// The path of an entry `name`, which need not exist.
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

/// Runs a line of the shell. Throws Error with `what` and the line of its error stream that says
/// most unless it succeeds.
void RunShell(const std::string& line, const ScratchFolder& folder, const std::string& what);

}  // namespace skein
