// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/error.h"

namespace skein {

/// The address of the function `entry` of the shared object `file`, which is loaded when it is
/// first asked for, and never closed. The dynamic loader finds it by the program's run path. Throws
/// Error with the reason alone: the caller says what to do.
void* FindModuleEntry(const std::string& file, const char* entry);

/// A module that was found, and is of another build than the program.
class OtherBuild : public Error {
 public:
  using Error::Error;
};

/// " (REASON)" of why a module was not loaded, with ": ADVICE" on how to install it behind it where
/// that is what it lacks.
std::string WhyNotLoaded(const Error& reason, const std::string& advice);

/// What the function `entry` of a module returns for `build`, the caller's SKEIN_BUILD_ID: an
/// interface, or null if the module's own is another. Throws OtherBuild then.
template <typename Entry>
auto& LoadModule(const std::string& file, const char* entry, const char* build) {
  auto* const module = reinterpret_cast<Entry*>(FindModuleEntry(file, entry))(build);
  if (module == nullptr) {
    throw OtherBuild(file + " is of another build than " + build +
                     "; build, or install, all of Skein again");
  }
  return *module;
}

}  // namespace skein
