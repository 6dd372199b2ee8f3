// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <xmmintrin.h>

namespace skein {

/// Flushes denormal results to zero and takes denormal operands as zero on this thread while it
/// lives: filters and gradients that decay would otherwise run many times slower.
class DenormalsFlushed {
 public:
  DenormalsFlushed() : before_(_mm_getcsr()) {
    constexpr unsigned kFlushToZero = 0x8000;
    constexpr unsigned kDenormalsAreZero = 0x0040;
    _mm_setcsr(before_ | kFlushToZero | kDenormalsAreZero);
  }
  ~DenormalsFlushed() { _mm_setcsr(before_); }
  DenormalsFlushed(const DenormalsFlushed&) = delete;
  DenormalsFlushed& operator=(const DenormalsFlushed&) = delete;

 private:
  unsigned before_;
};

}  // namespace skein
