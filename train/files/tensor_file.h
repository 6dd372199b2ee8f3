// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace skein {

/// A named array in a TensorFile. Bytes are little-endian.
struct NamedTensor {
  enum class Type { kF32, kF64, kU32, kU64, kI64, kU8 };
  Type type = Type::kF32;
  std::vector<std::int64_t> shape;
  std::vector<std::uint8_t> bytes;
};

/// Skein's container for checkpoints and policies, by the safetensors rules: 8-byte header length,
/// JSON header (at most 16 MiB) with string metadata and [begin, end) offsets that neither overlap
/// nor leave holes, then the bytes; in the metadata a checksum of header and bytes. No code, no
/// pickles, no control characters in names and texts but in those texts whose keys end in "_file".
struct TensorFile {
  std::map<std::string, std::string> metadata;
  std::map<std::string, NamedTensor> tensors;

  /// Atomic: temporary file in the same directory, fsync, rename, fsync of the directory. Throws
  /// Error on what Read would refuse, and if it cannot be written; an existing file is then
  /// untouched.
  void Write(const std::string& path) const;
  /// What Write writes. Throws Error on what Read would refuse.
  std::string Bytes() const;
  /// Throws Error with one clear line on a file that is missing, truncated, bit-flipped or foreign.
  static TensorFile Read(const std::string& path);
};

}  // namespace skein
