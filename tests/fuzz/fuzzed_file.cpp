// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/fuzzed_file.h"

#include <fstream>

#include "tests/scratch_directory.h"

namespace skein {

const std::string& InFile(const std::string& bytes, const char* extension) {
  static const ScratchDirectory scratch;
  static std::string path;
  path = scratch / "file" + extension;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

}  // namespace skein
