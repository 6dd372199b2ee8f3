// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdlib>
#include <string>

#include "base/error.h"

namespace skein::bench {

/// The whole number from 1 to 9,999,999 that `text`, the argument `name`, is. Throws Error if it is
/// none.
inline int Positive(const std::string& name, const std::string& text) {
  const bool digits =
      !text.empty() && text.size() < 8 &&
      std::all_of(text.begin(), text.end(), [](unsigned char c) { return c >= '0' && c <= '9'; });
  const int value = digits ? std::atoi(text.c_str()) : 0;
  if (value <= 0) throw Error(name + " must be a whole number from 1 to 9999999, not " + text);
  return value;
}

}  // namespace skein::bench
