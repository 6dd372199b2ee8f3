// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace skein {

/// What a report's page is given: a JSON document, and arrays of numbers that it refers to.
///
/// The bytes are a little-endian uint32, the length of the document; the document, padded with
/// spaces to a multiple of 8 bytes from the start; the arrays. In the document an array is
///   {"f32": [offset, count]}                         floats
///   {"f64": [offset, count]}                         doubles
///   {"i16": [offset, count], "first": a, "unit": u}  a + u * the running sum of the integers
/// with offsets in bytes from the first array. The running sum is modulo 2^16; where it is kNoLevel
/// there is no number.
class DataPack {
 public:
  /// Keeps the values as floats; what is not finite stays so. Where one of them is a whole number
  /// that no float is, as counts beyond 2^24 are, all are kept as doubles. Returns what refers to
  /// them.
  nlohmann::ordered_json AddNumbers(const std::vector<double>& values);
  static constexpr int kMostLevels = 65000;
  static constexpr std::uint16_t kNoLevel = 0xffff;
  /// Keeps the values to 1/`levels` of their range, as differences of neighbours modulo 2^16, which
  /// compress well, the better the fewer levels. Values that are not finite are not there
  /// (kNoLevel).
  nlohmann::ordered_json AddQuantised(const std::vector<double>& values, int levels = kMostLevels);

  /// The bytes, deflated (zlib, RFC 1950). Text in the document that is not UTF-8 is replaced by
  /// U+FFFD.
  std::string Deflated(const nlohmann::ordered_json& document) const;

 private:
  std::string arrays_;
};

/// RFC 4648, with padding.
std::string Base64(const std::string& bytes);

}  // namespace skein
