#pragma once

#include <string>

namespace skein {

/// The file of the policy that `path` stands for: of the directory of a run its best policy, else
/// the final one, else the newest checkpoint; otherwise `path` itself. Throws Error on a directory
/// that holds no run, or a run that has not saved a policy yet.
std::string PolicyFileOf(const std::string& path);

}  // namespace skein
