// SPDX-License-Identifier: Apache-2.0
#include "train/files/tensor_file.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "base/choice_error.h"
#include "base/ends_with.h"
#include "base/error.h"
#include "base/fnv_hash.h"
#include "train/files/file_descriptor.h"

namespace skein {
namespace {

// Sorted, so that a hostile header of very many names is still found in quickly.
using Json = nlohmann::json;

constexpr std::uint64_t kMaxHeaderBytes = 16u << 20;
constexpr std::uint64_t kLengthBytes = 8;
constexpr std::uint64_t kAlignment = 8;
constexpr const char* kMetadataKey = "__metadata__";
constexpr const char* kChecksumKey = "checksum";
constexpr std::size_t kChecksumDigits = 16;

struct TypeName {
  NamedTensor::Type type;
  const char* name;
  std::uint64_t bytes;
};

constexpr std::array<TypeName, 6> kTypes{{{NamedTensor::Type::kF32, "F32", 4},
                                          {NamedTensor::Type::kF64, "F64", 8},
                                          {NamedTensor::Type::kU32, "U32", 4},
                                          {NamedTensor::Type::kU64, "U64", 8},
                                          {NamedTensor::Type::kI64, "I64", 8},
                                          {NamedTensor::Type::kU8, "U8", 1}}};

const TypeName& Describe(NamedTensor::Type type) {
  return *std::find_if(kTypes.begin(), kTypes.end(),
                       [type](const TypeName& entry) { return entry.type == type; });
}

[[noreturn]] void Refuse(const std::string& path, const std::string& reason) {
  throw Error(path + ": not a valid Skein file: " + reason);
}

/// Bytes that a tensor of this shape takes; throws Error if they cannot be counted.
std::uint64_t ByteSize(const std::vector<std::int64_t>& shape, std::uint64_t element_bytes,
                       const std::string& path, const std::string& name) {
  std::uint64_t bytes = element_bytes;
  for (const std::int64_t extent : shape) {
    if (extent < 0 || __builtin_mul_overflow(bytes, static_cast<std::uint64_t>(extent), &bytes)) {
      Refuse(path, "tensor \"" + name + "\" has an impossible shape");
    }
  }
  return bytes;
}

std::string ChecksumField(const std::string& value) {
  return std::string("\"") + kChecksumKey + "\":\"" + value + "\"";
}

const std::string& BlankChecksumField() {
  static const std::string blank = ChecksumField(std::string(kChecksumDigits, '0'));
  return blank;
}

Json::const_reference Member(const Json& object, const char* key, const std::string& path,
                             const std::string& name) {
  const auto found = object.find(key);
  if (found == object.end()) Refuse(path, "tensor \"" + name + "\" has no " + key);
  return *found;
}

/// A tensor's description in the header, without its bytes.
struct Entry {
  std::string name;
  NamedTensor tensor;
  std::uint64_t begin = 0, end = 0;
};

Entry ParseEntry(const std::string& name, const Json& json, const std::string& path) {
  if (!json.is_object() || json.size() != 3) {
    Refuse(path, "tensor \"" + name + "\" is not described by dtype, shape and data_offsets");
  }
  Entry entry;
  entry.name = name;
  const Json& type = Member(json, "dtype", path, name);
  const auto known = std::find_if(kTypes.begin(), kTypes.end(), [&](const TypeName& candidate) {
    return type.is_string() && type.get_ref<const std::string&>() == candidate.name;
  });
  if (known == kTypes.end()) Refuse(path, "tensor \"" + name + "\" has an unknown dtype");
  entry.tensor.type = known->type;
  const Json& shape = Member(json, "shape", path, name);
  const Json& offsets = Member(json, "data_offsets", path, name);
  if (!shape.is_array() || !offsets.is_array() || offsets.size() != 2) {
    Refuse(path, "tensor \"" + name + "\" has no proper shape and data_offsets");
  }
  for (const Json& extent : shape) {
    if (!extent.is_number_integer()) Refuse(path, "tensor \"" + name + "\" has an improper shape");
    entry.tensor.shape.push_back(extent.get<std::int64_t>());
  }
  if (!offsets[0].is_number_unsigned() || !offsets[1].is_number_unsigned()) {
    Refuse(path, "tensor \"" + name + "\" has improper data_offsets");
  }
  entry.begin = offsets[0].get<std::uint64_t>();
  entry.end = offsets[1].get<std::uint64_t>();
  const std::uint64_t bytes = ByteSize(entry.tensor.shape, known->bytes, path, name);
  if (entry.end < entry.begin || entry.end - entry.begin != bytes) {
    Refuse(path, "the offsets of tensor \"" + name + "\" do not fit its shape");
  }
  return entry;
}

std::string_view TextOf(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Keys of texts that are whole files end so.
constexpr const char* kWholeFile = "_file";

/// As names and texts are: they stand in errors.
bool IsOneLine(const std::string& text) {
  const auto breaks = [](unsigned char c) { return c < 0x20 || c == 0x7F; };
  return std::none_of(text.begin(), text.end(), breaks);
}

void RequireOneLine(const std::string& text, const std::string& path) {
  if (!IsOneLine(text)) Refuse(path, "its header has a control character in a name or text");
}

/// The tensors that the header describes, in the order of their bytes.
std::vector<Entry> ParseHeader(const std::string& text, std::uint64_t data_size,
                               const std::string& path,
                               std::map<std::string, std::string>* metadata) {
  const Json header = Json::parse(text, nullptr, false);
  if (!header.is_object() || text.front() != '{') Refuse(path, "its header is not a JSON object");
  std::vector<Entry> entries;
  for (const auto& [name, json] : header.items()) {
    RequireOneLine(name, path);
    if (name != kMetadataKey) {
      entries.push_back(ParseEntry(name, json, path));
      continue;
    }
    if (!json.is_object()) Refuse(path, "its metadata is not an object");
    for (const auto& [key, value] : json.items()) {
      RequireOneLine(key, path);
      if (!value.is_string()) Refuse(path, "its metadata holds something else than text");
      (*metadata)[key] = value.get<std::string>();
      if (!EndsWith(key, kWholeFile)) RequireOneLine((*metadata)[key], path);
    }
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.begin != b.begin ? a.begin < b.begin : a.end < b.end;
  });
  std::uint64_t expected = 0;
  for (const Entry& entry : entries) {
    if (entry.begin != expected) Refuse(path, "its tensors overlap or leave holes");
    expected = entry.end;
  }
  if (expected != data_size) Refuse(path, "its data has the wrong size (truncated or extended)");
  return entries;
}

/// JSON is UTF-8.
std::string HeaderText(const nlohmann::ordered_json& header, const std::string& path) {
  try {
    return header.dump();
  } catch (const nlohmann::json::exception&) {
    throw Error(path + ": a name or text of its header is not UTF-8");
  }
}

/// All that stands before the tensors' bytes. `path` is what errors call the file.
std::string HeadOf(const TensorFile& file, const std::string& path) {
  const auto require_one_line = [&path](const std::string& text) {
    if (!IsOneLine(text))
      throw Error(path + ": a name or text of its header has a control character");
  };
  nlohmann::ordered_json header;
  nlohmann::ordered_json& texts = header[kMetadataKey];
  texts[kChecksumKey] = std::string(kChecksumDigits, '0');
  for (const auto& [key, value] : file.metadata) {
    if (key == kChecksumKey) throw Error(path + ": metadata key \"checksum\" is reserved");
    require_one_line(key);
    if (!EndsWith(key, kWholeFile)) require_one_line(value);
    texts[key] = value;
  }
  std::uint64_t offset = 0;
  for (const auto& [name, tensor] : file.tensors) {
    if (name == kMetadataKey) throw Error(path + ": tensor name \"__metadata__\" is reserved");
    require_one_line(name);
    const TypeName& type = Describe(tensor.type);
    if (ByteSize(tensor.shape, type.bytes, path, name) != tensor.bytes.size()) {
      throw Error(path + ": tensor \"" + name + "\" does not have the bytes of its shape");
    }
    const std::uint64_t end = offset + tensor.bytes.size();
    header[name] = {{"dtype", type.name}, {"shape", tensor.shape}, {"data_offsets", {offset, end}}};
    offset = end;
  }
  std::string text = HeaderText(header, path);
  // Spaces to a whole number of words, so that data is aligned when the file is mapped.
  text.append((kAlignment - text.size() % kAlignment) % kAlignment, ' ');
  if (text.size() > kMaxHeaderBytes) throw Error(path + ": the header would exceed 16 MiB");
  // FNV-1a over the header, its checksum's digits as zeros, and the data.
  FnvHash hash;
  hash.Add(text.data(), text.size());
  for (const auto& [name, tensor] : file.tensors)
    hash.Add(tensor.bytes.data(), tensor.bytes.size());
  const std::size_t field = text.find(BlankChecksumField());
  text.replace(field, BlankChecksumField().size(), ChecksumField(hash.Hex()));
  std::string length;
  for (std::size_t i = 0; i < kLengthBytes; ++i) {
    length += static_cast<char>(static_cast<std::uint8_t>(text.size() >> (8 * i)));
  }
  return length + text;
}

}  // namespace

void TensorFile::Write(const std::string& path) const {
  const std::string head = HeadOf(*this, path);
  ReplaceFile(path, [&](FileDescriptor& file) {
    file.Write(head);
    for (const auto& [name, tensor] : tensors) file.Write(TextOf(tensor.bytes));
  });
}

std::string TensorFile::Bytes() const {
  std::string bytes = HeadOf(*this, "the file");
  for (const auto& [name, tensor] : tensors) bytes += TextOf(tensor.bytes);
  return bytes;
}

TensorFile TensorFile::Read(const std::string& path) {
  // Asked before it is opened, which could wait for ever on a pipe.
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) {
    const std::string message = path + ": " + (code ? code.message() : "not a regular file");
    // Links in a circle and the like are there, but cannot be read.
    if (!code || !std::filesystem::exists(path, code)) throw ChoiceError(message);
    throw Error(message);
  }
  FileDescriptor in(path, OpenMode::kRead);
  const std::uint64_t size = in.size();
  if (size < kLengthBytes) Refuse(path, "shorter than its length field");
  std::array<char, kLengthBytes> length_bytes;
  in.ReadExactly(length_bytes.data(), length_bytes.size());
  std::uint64_t length = 0;
  for (std::size_t i = 0; i < kLengthBytes; ++i) {
    length |= static_cast<std::uint64_t>(static_cast<std::uint8_t>(length_bytes[i])) << (8 * i);
  }
  if (length > kMaxHeaderBytes || length > size - kLengthBytes) {
    Refuse(path, "its header length is impossible (foreign or truncated)");
  }
  std::string text(length, '\0');
  in.ReadExactly(text.data(), text.size());

  TensorFile file;
  const std::uint64_t data_size = size - kLengthBytes - length;
  std::vector<Entry> entries = ParseHeader(text, data_size, path, &file.metadata);
  const std::string checksum = file.metadata[kChecksumKey];
  file.metadata.erase(kChecksumKey);
  const std::size_t field = text.find(ChecksumField(checksum));
  if (checksum.size() != kChecksumDigits || field == std::string::npos) {
    Refuse(path, "it has no checksum");
  }
  text.replace(field, BlankChecksumField().size(), BlankChecksumField());
  FnvHash hash;
  hash.Add(text.data(), text.size());
  for (Entry& entry : entries) {
    entry.tensor.bytes.resize(entry.end - entry.begin);
    in.ReadExactly(reinterpret_cast<char*>(entry.tensor.bytes.data()), entry.tensor.bytes.size());
    hash.Add(entry.tensor.bytes.data(), entry.tensor.bytes.size());
    file.tensors.emplace(std::move(entry.name), std::move(entry.tensor));
  }
  if (hash.Hex() != checksum) Refuse(path, "its checksum does not match (damaged)");
  return file;
}

}  // namespace skein
