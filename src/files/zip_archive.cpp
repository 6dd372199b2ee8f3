// SPDX-License-Identifier: Apache-2.0
#include "src/files/zip_archive.h"

#include <zlib.h>

#include <cstdint>
#include <limits>

#include "base/error.h"

namespace skein {
namespace {

constexpr std::uint32_t kLocalHeader = 0x04034b50, kDirectoryHeader = 0x02014b50,
                        kDirectoryEnd = 0x06054b50;
constexpr std::uint16_t kVersion = 20, kDeflated = 8, kUtf8Names = 1 << 11;
constexpr std::uint16_t kFirstDay = (1 << 5) | 1;  // 1980-01-01, the earliest that there is

class LittleEndian {
 public:
  LittleEndian& Two(std::uint32_t value) { return Bytes(value, 2); }
  LittleEndian& Four(std::uint32_t value) { return Bytes(value, 4); }
  const std::string& text() const { return text_; }

 private:
  LittleEndian& Bytes(std::uint32_t value, int count) {
    for (int i = 0; i < count; ++i) text_.push_back(static_cast<char>(value >> (8 * i) & 0xFF));
    return *this;
  }

  std::string text_;
};

/// Without the header of zlib.
std::string Deflated(const std::string& content) {
  z_stream stream{};
  constexpr int kRawWindow = -15, kMemoryLevel = 8;
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kRawWindow, kMemoryLevel,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw Error("the archive cannot be compressed: out of memory");
  }
  std::string bytes(deflateBound(&stream, content.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  deflate(&stream, Z_FINISH);  // into room for all of it
  bytes.resize(stream.total_out);
  deflateEnd(&stream);
  return bytes;
}

}  // namespace

std::string ZipArchive(const std::string& name, const std::string& content) {
  if (content.size() > std::numeric_limits<std::uint32_t>::max() / 2) {
    throw Error("the archive would be too large: record fewer or shorter flights");
  }
  const std::string deflated = Deflated(content);
  const auto checksum = static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size())));
  // What the header before the content and the directory behind it have in common.
  const std::string description = LittleEndian()
                                      .Two(kVersion)
                                      .Two(kUtf8Names)
                                      .Two(kDeflated)
                                      .Two(0)
                                      .Two(kFirstDay)
                                      .Four(checksum)
                                      .Four(static_cast<std::uint32_t>(deflated.size()))
                                      .Four(static_cast<std::uint32_t>(content.size()))
                                      .Two(static_cast<std::uint32_t>(name.size()))
                                      .Two(0)
                                      .text();
  const std::string file = LittleEndian().Four(kLocalHeader).text() + description + name + deflated;
  const std::string directory = LittleEndian().Four(kDirectoryHeader).Two(kVersion).text() +
                                description +
                                LittleEndian().Two(0).Two(0).Two(0).Four(0).Four(0).text() + name;
  return file + directory +
         LittleEndian()
             .Four(kDirectoryEnd)
             .Two(0)
             .Two(0)
             .Two(1)
             .Two(1)
             .Four(static_cast<std::uint32_t>(directory.size()))
             .Four(static_cast<std::uint32_t>(file.size()))
             .Two(0)
             .text();
}

}  // namespace skein
