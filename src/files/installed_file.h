// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace skein {

/// The path of what is called `name` in the folder share/skein/ of the installation that the
/// running program belongs to; empty if it is not there, as in a build tree.
std::string InstalledFile(const std::string& name);

/// The path of what is called `name` in the build tree that the running program was built in; empty
/// if it is not there, as in an installation.
std::string BuiltFile(const std::string& name);

}  // namespace skein
