// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/error.h"

namespace skein {

/// The address of the function `entry` of the shared object `file`, which is loaded when it is
/// first asked for, and never closed. The dynamic loader finds it by the program's run path. Throws
/// Error with the reason alone: the caller says what to do.
void* FindModuleEntry(const std::string& file, const char* entry);

/// What the function `entry` of a module returns for `build`, the caller's SKEIN_BUILD_ID: an
/// interface, or null if the module's own is another.
template <typename Entry>
auto& LoadModule(const std::string& file, const char* entry, const char* build) {
  auto* const module = reinterpret_cast<Entry*>(FindModuleEntry(file, entry))(build);
  if (module == nullptr) throw Error(file + " is of another build than " + build);
  return *module;
}

}  // namespace skein
