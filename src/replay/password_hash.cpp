// SPDX-License-Identifier: Apache-2.0
#include "src/replay/password_hash.h"

#include <fmt/format.h>

#include <cstdint>

#include "base/error.h"

namespace skein {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint64_t kCrc64Polynomial = 0x42F0E1EBA9EA3693, kAllOnes = ~std::uint64_t{0};
constexpr std::uint32_t kReflectedCrc32Polynomial = 0xEDB88320;

/// Bytes that follow the first one of a character, and the bits of it that count; no character
/// begins otherwise.
struct Lead {
  int followers = 0;
  std::uint32_t bits = 0;
};

Lead LeadOf(std::uint8_t byte) {
  if (byte < 0x80) return {0, byte};
  if (byte >= 0xC2 && byte < 0xE0) return {1, byte & 0x1Fu};
  if (byte >= 0xE0 && byte < 0xF0) return {2, byte & 0x0Fu};
  if (byte >= 0xF0 && byte < 0xF5) return {3, byte & 0x07u};
  throw Error("the password is not UTF-8");
}

std::vector<std::uint32_t> CharactersOf(const std::string& text) {
  std::vector<std::uint32_t> characters;
  for (std::size_t i = 0; i < text.size();) {
    const Lead lead = LeadOf(static_cast<std::uint8_t>(text[i++]));
    std::uint32_t character = lead.bits;
    for (int k = 0; k < lead.followers; ++k, ++i) {
      const auto byte = static_cast<std::uint8_t>(i < text.size() ? text[i] : 0);
      if ((byte & 0xC0) != 0x80) throw Error("the password is not UTF-8");
      character = character << 6 | (byte & 0x3Fu);
    }
    characters.push_back(character);
  }
  return characters;
}

Bytes Utf16(const std::string& text) {
  Bytes bytes;
  const auto add = [&bytes](std::uint32_t unit) {
    bytes.push_back(static_cast<std::uint8_t>(unit & 0xFF));
    bytes.push_back(static_cast<std::uint8_t>(unit >> 8));
  };
  for (const std::uint32_t character : CharactersOf(text)) {
    if (character < 0x10000) {
      add(character);
      continue;
    }
    add(0xD800 + ((character - 0x10000) >> 10));
    add(0xDC00 + ((character - 0x10000) & 0x3FF));
  }
  return bytes;
}

std::uint64_t Crc64(const Bytes& bytes, std::uint64_t initial) {
  std::uint64_t crc = initial;
  for (const std::uint8_t byte : bytes) {
    crc ^= static_cast<std::uint64_t>(byte) << 56;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc >> 63) != 0 ? crc << 1 ^ kCrc64Polynomial : crc << 1;
    }
  }
  return crc ^ initial;
}

std::uint32_t Crc32(const Bytes& bytes) {
  std::uint32_t crc = ~std::uint32_t{0};
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc & 1) != 0 ? crc >> 1 ^ kReflectedCrc32Polynomial : crc >> 1;
    }
  }
  return ~crc;
}

}  // namespace

std::vector<std::string> TelemetryPasswordHashes(const std::string& password) {
  const Bytes bytes = Utf16(password);
  return {fmt::format("{:x}", Crc64(bytes, kAllOnes)), fmt::format("{:x}", Crc64(bytes, 0)),
          fmt::format("{:x}", Crc32(bytes))};
}

}  // namespace skein
