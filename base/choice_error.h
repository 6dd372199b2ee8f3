// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/error.h"

namespace skein {

/// What was given by its path or name is not there, or is of another kind than asked for: a
/// directory for a file, a folder that holds no run. Whoever gave it is to give another one.
class ChoiceError : public Error {
 public:
  /// As of Error.
  explicit ChoiceError(const std::string& message) : Error(message) {}
};

}  // namespace skein
