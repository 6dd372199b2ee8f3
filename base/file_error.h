// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/error.h"

namespace skein {

/// A file could not be opened, read or written though it is there, or has room: the system says
/// why. Nothing that was asked for is to blame.
class FileError : public Error {
 public:
  /// As of Error.
  explicit FileError(const std::string& message) : Error(message) {}
};

}  // namespace skein
