// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <new>

namespace skein {

/// What people are told of a failure: its message, or what helps where there is no memory. Asks for
/// none itself; the text is there as long as `failure`.
inline const char* ReasonOf(const std::exception& failure) {
  if (dynamic_cast<const std::bad_alloc*>(&failure) == nullptr) return failure.what();
  return "out of memory; fewer aircraft or shorter rollouts need less";
}

}  // namespace skein
