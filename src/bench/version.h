// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

/// What this program was built from and how.
struct BuildInfo {
  const char* version;  ///< "0.3.0"
  /// Of the source tree; behind it "-dirty" if changed, and then a hash of what changed, if builds
  /// read it; or "unknown".
  const char* commit;
  const char* date;      ///< of the commit: "2026-11-22"; empty if it is unknown
  const char* compiler;  ///< "GNU 12.2.0"
  const char* type;      ///< of the build: "Release"
};

const BuildInfo& Build();

}  // namespace skein
