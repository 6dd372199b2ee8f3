// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/error.h"
#include "base/file_error.h"

namespace skein {

/// What the command line, or a configuration that it names, asks for cannot be. The program exits
/// with 2 instead of 1.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& message) : Error(message) {}
};

/// What `read` returns. An Error of it becomes a UsageError, a FileError excepted: for steps that
/// only interpret what was asked for.
template <typename Read>
auto AsUsage(const Read& read) -> decltype(read()) {
  try {
    return read();
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
}

}  // namespace skein
