// SPDX-License-Identifier: Apache-2.0
#include "src/files/zip_archive.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>

namespace skein {
namespace {

/// A little-endian number of `count` bytes at `offset`.
std::uint32_t At(const std::string& bytes, std::size_t offset, int count) {
  std::uint32_t value = 0;
  for (int i = count - 1; i >= 0; --i) {
    value = value << 8 | static_cast<unsigned char>(bytes.at(offset + static_cast<std::size_t>(i)));
  }
  return value;
}

TEST(ZipArchiveTest, HoldsTheFileThatItsDirectoryDescribes) {
  std::string content;
  for (int i = 0; i < 20000; ++i) content += std::to_string(i * 7919 % 1000) + "\n";
  const std::string name = "flights.txt.acmi", archive = ZipArchive(name, content);
  EXPECT_LT(archive.size(), content.size() / 2);
  const std::size_t end = archive.size() - 22;
  ASSERT_EQ(At(archive, end, 4), 0x06054b50u);
  EXPECT_EQ(At(archive, end + 10, 2), 1u) << "one file";
  const std::size_t directory = At(archive, end + 16, 4);
  EXPECT_EQ(directory + At(archive, end + 12, 4), end);
  ASSERT_EQ(At(archive, directory, 4), 0x02014b50u);
  EXPECT_EQ(archive.substr(directory + 46, name.size()), name);
  const std::size_t header = At(archive, directory + 42, 4);
  ASSERT_EQ(At(archive, header, 4), 0x04034b50u);
  // From the version on to the name's length both say the same.
  EXPECT_EQ(archive.substr(header + 4, 26), archive.substr(directory + 6, 26));
  const std::size_t packed = At(archive, header + 18, 4), unpacked = At(archive, header + 22, 4);
  ASSERT_EQ(unpacked, content.size());
  std::string inflated(unpacked, '\0');
  z_stream stream{};
  ASSERT_EQ(inflateInit2(&stream, -15), Z_OK);
  std::string deflated = archive.substr(header + 30 + name.size(), packed);
  stream.next_in = reinterpret_cast<Bytef*>(deflated.data());
  stream.avail_in = static_cast<uInt>(packed);
  stream.next_out = reinterpret_cast<Bytef*>(inflated.data());
  stream.avail_out = static_cast<uInt>(unpacked);
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  inflateEnd(&stream);
  EXPECT_TRUE(inflated == content);
  EXPECT_EQ(At(archive, header + 14, 4), crc32(0, reinterpret_cast<const Bytef*>(content.data()),
                                               static_cast<uInt>(content.size())));
  EXPECT_TRUE(archive == ZipArchive(name, content));
}

}  // namespace
}  // namespace skein
