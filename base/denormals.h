// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace skein {

/// The register of a thread's floating-point modes, on processors whose denormals can be flushed;
/// on others it has none, and denormals stay.
namespace float_modes {

#if defined(__SSE__)
using Modes = std::uint32_t;                      // MXCSR
inline constexpr Modes kFlushDenormals = 0x8040;  // results to zero, operands as zero
inline Modes Get() { return _mm_getcsr(); }
inline void Set(Modes modes) { _mm_setcsr(modes); }
#elif defined(__aarch64__)
using Modes = std::uint64_t;                              // FPCR
inline constexpr Modes kFlushDenormals = Modes{1} << 24;  // FZ: results and operands
inline Modes Get() {
  Modes modes;
  asm volatile("mrs %0, fpcr" : "=r"(modes));
  return modes;
}
// The compiler must not move floating-point stores over it.
inline void Set(Modes modes) { asm volatile("msr fpcr, %0" : : "r"(modes) : "memory"); }
#else
using Modes = int;
inline constexpr Modes kFlushDenormals = 0;
inline Modes Get() { return 0; }
inline void Set(Modes) {}
#endif

}  // namespace float_modes

/// Flushes denormal results to zero and takes denormal operands as zero on this thread while it
/// lives: filters and gradients that decay would otherwise run many times slower.
class DenormalsFlushed {
 public:
  DenormalsFlushed() : before_(float_modes::Get()) {
    float_modes::Set(before_ | float_modes::kFlushDenormals);
  }
  ~DenormalsFlushed() { float_modes::Set(before_); }
  DenormalsFlushed(const DenormalsFlushed&) = delete;
  DenormalsFlushed& operator=(const DenormalsFlushed&) = delete;

 private:
  float_modes::Modes before_;
};

}  // namespace skein
