// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/number_text.h"
#include "train/files/tensor_file.h"

namespace skein {

/// The element type's name in a tensor file.
template <typename T>
constexpr NamedTensor::Type TensorTypeOf() {
  if constexpr (std::is_same_v<T, float>) return NamedTensor::Type::kF32;
  if constexpr (std::is_same_v<T, double>) return NamedTensor::Type::kF64;
  if constexpr (std::is_same_v<T, std::uint32_t>) return NamedTensor::Type::kU32;
  if constexpr (std::is_same_v<T, std::uint64_t>) return NamedTensor::Type::kU64;
  if constexpr (std::is_same_v<T, std::int64_t>) return NamedTensor::Type::kI64;
  if constexpr (std::is_same_v<T, std::uint8_t>) return NamedTensor::Type::kU8;
}

/// A number for a file's metadata: seventeen digits, so that the double comes back as it was.
inline std::string ExactText(double value) { return RoundedText(value, 17); }

/// `text`, what metadata `key` holds, as a finite number; throws Error, naming `path`, if it is
/// none.
inline double ToNumber(const std::string& text, const std::string& path, const std::string& key) {
  const std::optional<double> value = NumberOf(text);
  if (!value || !std::isfinite(*value)) {
    throw Error(path + ": \"" + key + "\" is \"" + text + "\", which is no number");
  }
  return *value;
}

/// Puts all of `from` into `to`, with `prefix` before the names.
template <typename Value>
void InsertWithPrefix(const std::map<std::string, Value>& from, const std::string& prefix,
                      std::map<std::string, Value>& to) {
  for (const auto& [name, value] : from) to[prefix + name] = value;
}

/// What has the prefix, without it.
template <typename Value>
std::map<std::string, Value> ExtractPrefix(const std::map<std::string, Value>& from,
                                           const std::string& prefix) {
  std::map<std::string, Value> part;
  for (auto it = from.lower_bound(prefix);
       it != from.end() && it->first.compare(0, prefix.size(), prefix) == 0; ++it) {
    part[it->first.substr(prefix.size())] = it->second;
  }
  return part;
}

/// Adds `count` values as a tensor of `shape`. Skein runs on little-endian machines alone.
template <typename T>
void StoreTensor(TensorFile& file, const std::string& name, std::vector<std::int64_t> shape,
                 const T* values, std::size_t count) {
  NamedTensor tensor;
  tensor.type = TensorTypeOf<T>();
  tensor.shape = std::move(shape);
  tensor.bytes.resize(count * sizeof(T));
  if (count > 0) std::memcpy(tensor.bytes.data(), values, tensor.bytes.size());
  file.tensors[name] = std::move(tensor);
}

/// The tensor `name`, which must be of T; throws Error, naming `path`, otherwise.
template <typename T>
const NamedTensor& FindTensor(const TensorFile& file, const std::string& path,
                              const std::string& name) {
  const auto found = file.tensors.find(name);
  if (found == file.tensors.end()) throw Error(path + ": it has no tensor \"" + name + "\"");
  if (found->second.type != TensorTypeOf<T>()) {
    throw Error(path + ": tensor \"" + name + "\" has another type than expected");
  }
  return found->second;
}

/// The values of a tensor of any shape; TensorFile has seen to it that bytes and shape fit.
template <typename T>
std::vector<T> LoadTensor(const TensorFile& file, const std::string& path,
                          const std::string& name) {
  const NamedTensor& tensor = FindTensor<T>(file, path, name);
  std::vector<T> values(tensor.bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), tensor.bytes.data(), tensor.bytes.size());
  return values;
}

/// The values of a tensor of exactly this shape.
template <typename T>
std::vector<T> LoadTensor(const TensorFile& file, const std::string& path, const std::string& name,
                          const std::vector<std::int64_t>& shape) {
  if (FindTensor<T>(file, path, name).shape != shape) {
    throw Error(path + ": tensor \"" + name + "\" has another shape than expected");
  }
  return LoadTensor<T>(file, path, name);
}

}  // namespace skein
