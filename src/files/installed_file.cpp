// SPDX-License-Identifier: Apache-2.0
#include "src/files/installed_file.h"

#include <filesystem>

namespace skein {

namespace fs = std::filesystem;

std::string InstalledFile(const std::string& name) {
  std::error_code failure;
  const fs::path programs = fs::read_symlink("/proc/self/exe", failure).parent_path();
  const fs::path path = (programs / "../share/skein" / name).lexically_normal();
  return fs::exists(path, failure) ? path.string() : "";
}

}  // namespace skein
