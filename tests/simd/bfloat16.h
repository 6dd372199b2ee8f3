// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>

namespace skein::simd {

/// The upper 16 bits of a float32 rounded to bfloat16, to nearest even, as the instruction
/// vcvtneps2bf16 does: denormals become zero of their sign, a NaN becomes quiet.
inline std::uint16_t RoundToBfloat16(float x) {
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  const std::uint32_t magnitude = bits & 0x7fffffffu;
  if (magnitude < 0x00800000u) {
    bits &= 0x80000000u;
  } else if (magnitude > 0x7f800000u) {
    bits |= 0x00400000u;
  } else {
    bits += 0x7fffu + ((bits >> 16) & 1);
  }
  return static_cast<std::uint16_t>(bits >> 16);
}

/// The value of a bfloat16.
inline float Bfloat16Value(std::uint16_t x) {
  const std::uint32_t bits = static_cast<std::uint32_t>(x) << 16;
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

}  // namespace skein::simd
