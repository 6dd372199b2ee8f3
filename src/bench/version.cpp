// SPDX-License-Identifier: Apache-2.0
#include "src/bench/version.h"

namespace skein {

// Of the generated commit.cpp (cmake/Commit.cmake).
extern const char* const kCommit;
extern const char* const kCommitDate;

const BuildInfo& Build() {
  static const BuildInfo build{SKEIN_VERSION, kCommit, kCommitDate, SKEIN_COMPILER,
                               SKEIN_BUILD_TYPE};
  return build;
}

}  // namespace skein
