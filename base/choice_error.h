// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "base/error.h"

namespace skein {

/// What was given is not there, is of another kind than asked for, or cannot be flown: a directory
/// for a file, a folder that holds no run, a start without steady flight. Whoever gave it is to
/// give another one.
class ChoiceError : public Error {
 public:
  /// As of Error.
  explicit ChoiceError(const std::string& message) : Error(message) {}
};

}  // namespace skein
