// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace skein {

/// A reader of files that anybody may have written.
struct FuzzTarget {
  const char* name;
  /// Files that the reader takes, to begin with: the repository's own.
  std::vector<std::string> (*seeds)();
  /// The file with what a forger would set right after a change: lengths and checksums.
  std::string (*repaired)(std::string file);
  /// Reads the file, and uses what it holds. Throws Error on one that it refuses.
  void (*read)(const std::string& file);
  /// The longest file that libFuzzer tries: what is longer than the seeds takes time and shows
  /// nothing new.
  std::size_t max_bytes;
};

/// How a test calls it.
inline std::ostream& operator<<(std::ostream& out, const FuzzTarget& target) {
  return out << target.name;
}

const std::vector<FuzzTarget>& FuzzTargets();

/// Whether the reader takes the file. Throws std::logic_error if it refuses it otherwise than by an
/// Error of one line.
bool Takes(const FuzzTarget& target, const std::string& file);

}  // namespace skein
