// SPDX-License-Identifier: Apache-2.0
#include "src/report/data_pack.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

#include "base/error.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kAlignment = 8;

template <typename T>
void AppendLittleEndian(T value, std::string* bytes) {
  static_assert(sizeof(T) <= 8);
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(T));
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes->push_back(static_cast<char>((bits >> (8 * i)) & 0xff));
  }
}

void PadToAlignment(char filler, std::string* bytes) {
  bytes->append((kAlignment - bytes->size() % kAlignment) % kAlignment, filler);
}

/// Of the values that are finite; zeros if none is.
struct Range {
  double low = 0, high = 0;
};

Range FiniteRange(const std::vector<double>& values) {
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double value) { return std::isfinite(value); });
  if (finite.empty()) return {};
  const auto [low, high] = std::minmax_element(finite.begin(), finite.end());
  return {*low, *high};
}

/// Whether it is whole, and a float would be another number.
bool IsCountBeyondFloats(double value) {
  return std::isfinite(value) && std::trunc(value) == value &&
         static_cast<double>(static_cast<float>(value)) != value;
}

}  // namespace

Json DataPack::AddNumbers(const std::vector<double>& values) {
  const bool as_doubles = std::any_of(values.begin(), values.end(), IsCountBeyondFloats);
  Json reference = {{as_doubles ? "f64" : "f32", {arrays_.size(), values.size()}}};
  for (const double value : values) {
    if (as_doubles) {
      AppendLittleEndian(value, &arrays_);
    } else {
      AppendLittleEndian(static_cast<float>(value), &arrays_);
    }
  }
  PadToAlignment('\0', &arrays_);
  return reference;
}

Json DataPack::AddQuantised(const std::vector<double>& values, int levels) {
  const Range range = FiniteRange(values);
  const double unit = range.high == range.low ? 1 : (range.high - range.low) / levels;
  Json reference = {{"i16", {arrays_.size(), values.size()}}, {"first", range.low}, {"unit", unit}};
  std::uint16_t before = 0;
  for (const double value : values) {
    const std::uint16_t level =
        std::isfinite(value) ? static_cast<std::uint16_t>(std::lround((value - range.low) / unit))
                             : kNoLevel;
    AppendLittleEndian(static_cast<std::uint16_t>(level - before), &arrays_);
    before = level;
  }
  PadToAlignment('\0', &arrays_);
  return reference;
}

std::string DataPack::Deflated(const Json& document) const {
  std::string json = document.dump(-1, ' ', false, Json::error_handler_t::replace);
  json.append((kAlignment - (json.size() + 4) % kAlignment) % kAlignment, ' ');
  std::string bytes;
  AppendLittleEndian(static_cast<std::uint32_t>(json.size()), &bytes);
  bytes += json;
  bytes += arrays_;
  uLongf size = compressBound(bytes.size());
  std::string deflated(size, '\0');
  const int result =
      compress2(reinterpret_cast<Bytef*>(&deflated[0]), &size,
                reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_BEST_COMPRESSION);
  if (result != Z_OK) throw Error("the report's data cannot be compressed: out of memory");
  deflated.resize(size);
  return deflated;
}

std::string Base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const unsigned byte = i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0;
      group = group << 8 | byte;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool is_padding = i + k > bytes.size();
      text.push_back(is_padding ? '=' : kDigits[group >> (18 - 6 * k) & 63]);
    }
  }
  return text;
}

}  // namespace skein
