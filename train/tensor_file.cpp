#include "train/tensor_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "simd/error.h"
#include "train/fnv_hash.h"

namespace skein {
namespace {

using Json = nlohmann::ordered_json;

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

/// The checksum of a file: FNV-1a over the header, its checksum's digits as zeros, and the data.
template <typename Data>
std::string Checksum(const std::string& blank_header, const Data& add_data) {
  FnvHash hash;
  hash.Add(blank_header.data(), blank_header.size());
  add_data(hash);
  return hash.Hex();
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

std::string ReadWhole(const std::string& path) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) {
    throw Error(path + ": " + (code ? code.message() : "not a regular file"));
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw Error(path + ": cannot be opened: " + std::strerror(errno));
  std::string bytes;
  bytes.resize(std::filesystem::file_size(path));
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (static_cast<std::size_t>(stream.gcount()) != bytes.size()) {
    throw Error(path + ": cannot be read to its end");
  }
  return bytes;
}

/// A file descriptor that closes itself.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags)
      : path_(path), value_(open(path.c_str(), flags, 0644)) {
    if (value_ < 0) Fail("cannot be opened");
  }
  ~Descriptor() {
    if (value_ >= 0) close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  void Write(const void* data, std::size_t size) {
    const char* bytes = static_cast<const char*>(data);
    while (size > 0) {
      const ssize_t written = write(value_, bytes, size);
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) Fail("cannot be written");
      bytes += written;
      size -= static_cast<std::size_t>(written);
    }
  }
  void Sync() {
    if (fsync(value_) != 0) Fail("cannot be synced");
  }
  void Close() {
    const int value = value_;
    value_ = -1;
    if (close(value) != 0) Fail("cannot be closed");
  }

 private:
  [[noreturn]] void Fail(const char* what) const {
    throw Error(path_ + ": " + what + ": " + std::strerror(errno));
  }

  std::string path_;
  int value_;
};

}  // namespace

void TensorFile::Write(const std::string& path) const {
  Json header;
  Json& texts = header[kMetadataKey];
  texts = Json::object();
  texts[kChecksumKey] = std::string(kChecksumDigits, '0');
  for (const auto& [key, value] : metadata) {
    if (key == kChecksumKey) throw Error(path + ": metadata key \"checksum\" is reserved");
    texts[key] = value;
  }
  std::uint64_t offset = 0;
  for (const auto& [name, tensor] : tensors) {
    const TypeName& type = Describe(tensor.type);
    if (ByteSize(tensor.shape, type.bytes, path, name) != tensor.bytes.size()) {
      throw Error(path + ": tensor \"" + name + "\" does not have the bytes of its shape");
    }
    const std::uint64_t end = offset + tensor.bytes.size();
    header[name] = {{"dtype", type.name}, {"shape", tensor.shape}, {"data_offsets", {offset, end}}};
    offset = end;
  }
  std::string text = header.dump();
  // Spaces to a whole number of words, so that data is aligned when the file is mapped.
  text.append((kAlignment - text.size() % kAlignment) % kAlignment, ' ');
  if (text.size() > kMaxHeaderBytes) throw Error(path + ": the header would exceed 16 MiB");
  const std::string checksum = Checksum(text, [this](FnvHash& hash) {
    for (const auto& [name, tensor] : tensors) hash.Add(tensor.bytes.data(), tensor.bytes.size());
  });
  const std::size_t field = text.find(BlankChecksumField());
  text.replace(field, BlankChecksumField().size(), ChecksumField(checksum));
  std::array<std::uint8_t, kLengthBytes> length;
  for (std::size_t i = 0; i < kLengthBytes; ++i) {
    length[i] = static_cast<std::uint8_t>(text.size() >> (8 * i));
  }

  const std::string temporary = path + ".tmp";
  try {
    Descriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC);
    file.Write(length.data(), length.size());
    file.Write(text.data(), text.size());
    for (const auto& [name, tensor] : tensors) file.Write(tensor.bytes.data(), tensor.bytes.size());
    file.Sync();
    file.Close();
    if (std::rename(temporary.c_str(), path.c_str()) != 0) {
      throw Error(path + ": cannot be replaced: " + std::strerror(errno));
    }
  } catch (const Error&) {
    unlink(temporary.c_str());
    throw;
  }
  const std::string directory = std::filesystem::path(path).parent_path().string();
  Descriptor(directory.empty() ? "." : directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC).Sync();
}

TensorFile TensorFile::Read(const std::string& path) {
  const std::string bytes = ReadWhole(path);
  if (bytes.size() < kLengthBytes) Refuse(path, "shorter than its length field");
  std::uint64_t length = 0;
  for (std::size_t i = 0; i < kLengthBytes; ++i) {
    length |= static_cast<std::uint64_t>(static_cast<std::uint8_t>(bytes[i])) << (8 * i);
  }
  if (length > kMaxHeaderBytes || length > bytes.size() - kLengthBytes) {
    Refuse(path, "its header length is impossible (foreign or truncated)");
  }
  std::string text = bytes.substr(kLengthBytes, length);
  const char* const data = bytes.data() + kLengthBytes + length;
  const std::uint64_t data_size = bytes.size() - kLengthBytes - length;
  const Json header = Json::parse(text, nullptr, false);
  if (!header.is_object() || text.front() != '{') Refuse(path, "its header is not a JSON object");

  TensorFile file;
  std::string checksum;
  std::vector<Entry> entries;
  for (const auto& [name, json] : header.items()) {
    if (name != kMetadataKey) {
      entries.push_back(ParseEntry(name, json, path));
      continue;
    }
    if (!json.is_object()) Refuse(path, "its metadata is not an object");
    for (const auto& [key, value] : json.items()) {
      if (!value.is_string()) Refuse(path, "its metadata holds something else than text");
      if (key == kChecksumKey) {
        checksum = value.get<std::string>();
      } else {
        file.metadata[key] = value.get<std::string>();
      }
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

  const std::size_t field = text.find(ChecksumField(checksum));
  if (checksum.size() != kChecksumDigits || field == std::string::npos) {
    Refuse(path, "it has no checksum");
  }
  text.replace(field, BlankChecksumField().size(), BlankChecksumField());
  if (Checksum(text, [&](FnvHash& hash) { hash.Add(data, data_size); }) != checksum) {
    Refuse(path, "its checksum does not match (damaged)");
  }
  for (Entry& entry : entries) {
    entry.tensor.bytes.assign(data + entry.begin, data + entry.end);
    file.tensors.emplace(std::move(entry.name), std::move(entry.tensor));
  }
  return file;
}

}  // namespace skein
