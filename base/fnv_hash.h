// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace skein {

/// 64-bit FNV-1a (Fowler, Noll, Vo). Detects every change of a single byte.
class FnvHash {
 public:
  FnvHash() = default;
  /// Continues from what another hash had come to.
  explicit FnvHash(std::uint64_t value) : value_(value) {}

  void Add(const void* data, std::size_t size) {
    const auto* const bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * kPrime;
  }

  std::uint64_t value() const { return value_; }

  /// Sixteen hexadecimal digits.
  std::string Hex() const {
    std::string digits(16, '0');
    for (int i = 0; i < 16; ++i) digits[i] = "0123456789abcdef"[value_ >> (60 - 4 * i) & 15];
    return digits;
  }

 private:
  static constexpr std::uint64_t kPrime = 0x100000001b3;
  std::uint64_t value_ = 0xcbf29ce484222325;
};

/// The hash of a text in sixteen hexadecimal digits.
inline std::string HexHash(const std::string& text) {
  FnvHash hash;
  hash.Add(text.data(), text.size());
  return hash.Hex();
}

}  // namespace skein
