// SPDX-License-Identifier: Apache-2.0
#include "src/files/installed_file.h"

#include <filesystem>

namespace skein {

namespace fs = std::filesystem;

namespace {

/// `name` in the folder `beside` that of the running program; empty if it is not there.
std::string FileBeside(const std::string& beside, const std::string& name) {
  std::error_code failure;
  const fs::path programs = fs::read_symlink("/proc/self/exe", failure).parent_path();
  const fs::path path = (programs / beside / name).lexically_normal();
  return fs::exists(path, failure) ? path.string() : "";
}

}  // namespace

std::string InstalledFile(const std::string& name) { return FileBeside("../share/skein", name); }

std::string BuiltFile(const std::string& name) { return FileBeside("..", name); }

}  // namespace skein
