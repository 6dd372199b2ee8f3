// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simd/target.h"

namespace skein {

/// Makes kernels use one target while it lives.
class ScopedTarget {
 public:
  explicit ScopedTarget(simd::Target target) : previous_(simd::ActiveTarget()) {
    simd::ForceTarget(target);
  }
  ~ScopedTarget() { simd::ForceTarget(previous_); }
  ScopedTarget(const ScopedTarget&) = delete;
  ScopedTarget& operator=(const ScopedTarget&) = delete;

 private:
  simd::Target previous_;
};

}  // namespace skein
