// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace skein {

/// A command of skein that works in a folder of its own, in a fraction of a second.
struct FaultedCommand {
  const char* name;
  /// Puts into the folder what the command finds there.
  std::function<void(const std::string&)> prepare;
  /// The command line, of paths in the folder.
  std::function<std::vector<std::string>(const std::string&)> arguments;
  /// Of each fault how many calls are tried in the ordinary suite; of slow commands none.
  std::size_t sample = 1;
};

/// How a test calls it.
inline std::ostream& operator<<(std::ostream& out, const FaultedCommand& command) {
  return out << command.name;
}

/// Every command that writes files.
std::vector<FaultedCommand> FaultedCommands();

}  // namespace skein
