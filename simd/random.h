#pragma once

#include <array>
#include <cstdint>

namespace skein::simd {

/// What a random number is for. Part of the key, so that two uses never share a stream.
enum class RandomPurpose : std::uint32_t {
  kInitialState = 1,
  kTarget = 2,
  kObservationNoise = 3,
  kActionNoise = 4,
  kShuffle = 5,
  kClockStagger = 6,
  kNetworkInitialisation = 7,
};

/// Philox4x32-10 (Salmon, Moraes, Dror, Shaw: "Parallel random numbers: as easy as 1, 2, 3", SC
/// 2011): ten rounds on a 128-bit counter with a 64-bit key.
std::array<std::uint32_t, 4> Philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key);

/// The uniform float in [0, 1) made of the 24 high bits of `bits`.
inline float UniformFromBits(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1.0p-24f;
}

}  // namespace skein::simd
