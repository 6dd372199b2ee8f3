// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.h"

namespace skein {

/// The name that `names`, pairs of a value and its name, give `value`. Throws Error if they give it
/// none.
template <typename Names, typename Value>
const char* NameIn(const Names& names, Value value) {
  for (const auto& [known, name] : names) {
    if (known == value) return name;
  }
  throw Error("a configuration field holds a value without a name");
}

}  // namespace skein
