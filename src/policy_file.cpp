#include "src/policy_file.h"

#include <fmt/format.h>

#include <filesystem>

#include "simd/error.h"
#include "src/run_directory.h"

namespace skein {

std::string PolicyFileOf(const std::string& path) {
  if (!IsRunDirectory(path)) {
    if (!std::filesystem::is_directory(path)) return path;
    throw Error(
        fmt::format("{}: not the directory of a run (there is no config.toml in it)", path));
  }
  const std::string checkpoints = path + "/checkpoints";
  for (const char* name : {"/policy-best.skein", "/policy-final.skein"}) {
    if (std::filesystem::exists(checkpoints + name)) return checkpoints + name;
  }
  std::string newest;
  for (const Checkpoint& checkpoint : CheckpointsIn(checkpoints)) newest = checkpoint.path;
  if (newest.empty()) throw Error(fmt::format("{}: the run has not saved a policy yet", path));
  return newest;
}

}  // namespace skein
