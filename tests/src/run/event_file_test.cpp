// SPDX-License-Identifier: Apache-2.0
#include "src/run/event_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "src/files/output_file.h"
#include "tests/scratch_directory.h"

namespace skein {
namespace {

std::string Hex(std::string_view bytes) {
  std::string hex;
  for (const char c : bytes) {
    constexpr char kDigits[] = "0123456789abcdef";
    hex += kDigits[static_cast<unsigned char>(c) >> 4];
    hex += kDigits[static_cast<unsigned char>(c) & 15];
  }
  return hex;
}

TEST(EventFile, Crc32cMatchesPublishedVectors) {
  EXPECT_EQ(Crc32c("123456789"), 0xE3069283u);  // the check value of CRC-32C
  // RFC 3720, appendix B.4.
  EXPECT_EQ(Crc32c(std::string(32, '\0')), 0x8A9136AAu);
  EXPECT_EQ(Crc32c(std::string(32, '\xff')), 0x62A8AB43u);
}

TEST(EventFile, RecordsAreFramedAsTfRecords) {
  const std::string record = FrameRecord("123456789");
  ASSERT_EQ(record.size(), 8u + 4 + 9 + 4);
  EXPECT_EQ(Hex(record.substr(0, 8)), "0900000000000000");
  EXPECT_EQ(record.substr(12, 9), "123456789");
  // rotate(0xE3069283, 15) + 0xA282EAD8, little-endian.
  EXPECT_EQ(Hex(record.substr(21)), "e5b08ac7");
}

TEST(EventFile, ScalarsAreAnEventProtocolBuffer) {
  // wall_time = 1.0 (field 1, fixed64), step = 300 (field 2, varint), summary (field 5) { value
  // (field 1) { tag = "a" (field 1), simple_value = 0.5 (field 2, fixed32) } }.
  EXPECT_EQ(Hex(EncodeScalars(1.0, 300, {{"a", 0.5}})),
            "09000000000000f03f"
            "10ac02"
            "2a0a"
            "0a08"
            "0a0161"
            "150000003f");
}

TEST(EventFile, BeginsWithVersionAndSession) {
  const ScratchDirectory scratch;
  {
    EventFile file(scratch.path(), 1000, 1);
    file.Append(1001, 2, {{"train/return_mean", -3.5}});
  }
  const auto entry = *std::filesystem::directory_iterator(scratch.path());
  EXPECT_NE(entry.path().filename().string().find("tfevents"), std::string::npos)
      << "TensorBoard looks for this";
  const std::string text = ReadFile(entry.path().string());
  EXPECT_EQ(text.substr(12 + 11, 13), "brain.Event:2");
  EXPECT_NE(text.find("train/return_mean"), std::string::npos);
}

}  // namespace
}  // namespace skein
