// SPDX-License-Identifier: Apache-2.0
#include "src/bench/version.h"

namespace skein {

extern const char* const kCommit;  // of the generated commit.cpp (cmake/Commit.cmake)

const BuildInfo& Build() {
  static const BuildInfo build{SKEIN_VERSION, kCommit, SKEIN_COMPILER, SKEIN_BUILD_TYPE};
  return build;
}

}  // namespace skein
