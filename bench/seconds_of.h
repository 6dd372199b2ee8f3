// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "base/seconds_since.h"

namespace skein::bench {

/// What `call()` takes.
template <class Call>
double SecondsOf(const Call& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return SecondsSince(start);
}

}  // namespace skein::bench
