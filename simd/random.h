// SPDX-License-Identifier: Apache-2.0
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
  kWind = 8,
  kGustStart = 9,
  kGust = 10,
  kNoiseLevel = 11,
  kPlant = 12,
  kHeldActionNoise = 13,
};

/// Constants of Philox4x32-10 (Salmon et al., SC 2011, section 3.3).
namespace philox {
inline constexpr int kRounds = 10;
inline constexpr std::uint32_t kMultiplier0 = 0xD2511F53, kMultiplier1 = 0xCD9E8D57;
inline constexpr std::uint32_t kWeyl0 = 0x9E3779B9, kWeyl1 = 0xBB67AE85;
}  // namespace philox

/// Philox4x32-10 (Salmon, Moraes, Dror, Shaw: "Parallel random numbers: as easy as 1, 2, 3", SC
/// 2011): ten rounds on a 128-bit counter with a 64-bit key.
std::array<std::uint32_t, 4> Philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key);

/// What a number of one stream is drawn with: `seed` is the key; the counter is (a, b, c, purpose
/// and block). The environment uses a = aircraft, b = episode, c = control step, so that no number
/// depends on other environments of the batch, tiles or threads.
struct RandomKey {
  std::uint64_t seed = 0;
  std::uint32_t a = 0, b = 0, c = 0;
  RandomPurpose purpose{};
};

/// The `block`-th four words of a key's stream; block < 2^24.
std::array<std::uint32_t, 4> RandomWords(const RandomKey& key, std::uint32_t block);

/// The numbers of one key in order: a convenience over RandomWords where speed does not matter.
class RandomStream {
 public:
  explicit RandomStream(const RandomKey& key) : key_(key) {}

  std::uint32_t Word();
  /// Uniform in [0, 1), of 53 bits.
  double Uniform();
  /// Uniform in [min, max).
  double Uniform(double min, double max) { return min + (max - min) * Uniform(); }

 private:
  RandomKey key_;
  std::uint32_t drawn_ = 0;
  std::array<std::uint32_t, 4> words_{};
};

/// The uniform float in [0, 1) made of the 24 high bits of `bits`.
inline float UniformFromBits(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1.0p-24f;
}

/// Independent standard normal deviates: out[i * size + j] is the j-th of the key (seed, a = first
/// + i, b[i], c[i], purpose), for i < count and j < size. Box-Muller on Philox4x32-10; the largest
/// magnitude possible is 5.77. On every target the integers are the same; the floats are within
/// 5e-6 of the exact deviate.
void FillNormals(std::uint64_t seed, std::uint32_t first, const std::uint32_t* b,
                 const std::uint32_t* c, RandomPurpose purpose, int count, int size, float* out);

}  // namespace skein::simd
