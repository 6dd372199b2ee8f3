// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

/// The wire format of protocol buffers, as far as event files and ONNX models need it.
namespace skein::protobuf {

enum class WireType { kVarint = 0, kFixed64 = 1, kLengthDelimited = 2, kFixed32 = 5 };

/// The bytes of a number, lowest first.
template <typename T>
std::string LittleEndian(T value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(value));
  std::string bytes;
  for (std::size_t i = 0; i < sizeof(value); ++i) {
    bytes += static_cast<char>(static_cast<unsigned char>(bits >> (8 * i)));
  }
  return bytes;
}

inline std::string Varint(std::uint64_t value) {
  std::string bytes;
  for (; value >= 0x80; value >>= 7) {
    bytes += static_cast<char>(static_cast<unsigned char>(value | 0x80));
  }
  return bytes + static_cast<char>(value);
}

/// What stands before a field's value.
inline std::string Key(int field, WireType type) {
  return Varint(static_cast<std::uint64_t>(field) << 3 | static_cast<std::uint64_t>(type));
}

/// A field that is a text or a message.
inline std::string Message(int field, std::string_view content) {
  return Key(field, WireType::kLengthDelimited) + Varint(content.size()) + std::string(content);
}

/// A field that is a whole number, a truth value or an enumerator.
inline std::string Integer(int field, std::uint64_t value) {
  return Key(field, WireType::kVarint) + Varint(value);
}

/// A field that is a float32.
inline std::string Float(int field, float value) {
  return Key(field, WireType::kFixed32) + LittleEndian(value);
}

/// A field that is a float64.
inline std::string Double(int field, double value) {
  return Key(field, WireType::kFixed64) + LittleEndian(value);
}

}  // namespace skein::protobuf
