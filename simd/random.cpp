// SPDX-License-Identifier: Apache-2.0
#include "simd/random.h"

namespace skein::simd {

std::array<std::uint32_t, 4> Philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < philox::kRounds; ++round) {
    const std::uint64_t product0 = std::uint64_t{philox::kMultiplier0} * counter[0];
    const std::uint64_t product1 = std::uint64_t{philox::kMultiplier1} * counter[2];
    counter = {static_cast<std::uint32_t>(product1 >> 32) ^ counter[1] ^ key[0],
               static_cast<std::uint32_t>(product1),
               static_cast<std::uint32_t>(product0 >> 32) ^ counter[3] ^ key[1],
               static_cast<std::uint32_t>(product0)};
    key = {key[0] + philox::kWeyl0, key[1] + philox::kWeyl1};
  }
  return counter;
}

std::array<std::uint32_t, 4> RandomWords(const RandomKey& key, std::uint32_t block) {
  return Philox4x32(
      {key.a, key.b, key.c, static_cast<std::uint32_t>(key.purpose) | block << 8},
      {static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32)});
}

std::uint32_t RandomStream::Word() {
  const std::uint32_t element = drawn_ % 4;
  if (element == 0) words_ = RandomWords(key_, drawn_ / 4);
  ++drawn_;
  return words_[element];
}

double RandomStream::Uniform() {
  const std::uint64_t high = Word() >> 5, low = Word() >> 6;
  return static_cast<double>(high << 26 | low) * 0x1.0p-53;
}

}  // namespace skein::simd
