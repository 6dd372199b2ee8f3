// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace skein {

/// The one exception type of Skein. The message says what was wrong, where, and what would be
/// right, on one line.
class Error : public std::runtime_error {
 public:
  /// See above for what `message` says.
  explicit Error(const std::string& message) : std::runtime_error(message) {}
};

}  // namespace skein
