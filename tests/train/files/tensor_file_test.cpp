// SPDX-License-Identifier: Apache-2.0
#include "train/files/tensor_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "base/error.h"
#include "base/fnv_hash.h"
#include "tests/file_bytes.h"
#include "tests/scratch_directory.h"
#include "train/files/file_descriptor.h"

namespace skein {
namespace {

class TensorFileTest : public testing::Test {
 protected:
  static TensorFile Example() {
    TensorFile file;
    file.metadata["format"] = "example";
    file.tensors["a"] = {NamedTensor::Type::kF32, {2, 3}, std::vector<std::uint8_t>(24, 7)};
    file.tensors["b"] = {NamedTensor::Type::kU8, {5}, {1, 2, 3, 4, 5}};
    file.tensors["empty"] = {NamedTensor::Type::kU64, {0}, {}};
    return file;
  }

  std::string Bytes() const { return BytesOf(path_); }
  void Overwrite(const std::string& bytes) const {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  /// A file with this header and data, whose checksum (sixteen zeros in the header) is made right.
  void WriteForged(std::string header, const std::string& data) const {
    FnvHash hash;
    hash.Add(header.data(), header.size());
    hash.Add(data.data(), data.size());
    const std::size_t field = header.find("0000000000000000");
    if (field != std::string::npos) header.replace(field, 16, hash.Hex());
    std::string bytes(8, '\0');
    const std::uint64_t size = header.size();
    std::memcpy(bytes.data(), &size, 8);
    Overwrite(bytes + header + data);
  }
  std::string Refusal() const {
    try {
      TensorFile::Read(path_);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  const ScratchDirectory scratch_;
  const std::string path_ = scratch_ / "file.skein";
};

TEST_F(TensorFileTest, ComesBackAsItWas) {
  const TensorFile file = Example();
  file.Write(path_);
  const TensorFile back = TensorFile::Read(path_);
  EXPECT_EQ(back.metadata, file.metadata);
  ASSERT_EQ(back.tensors.size(), file.tensors.size());
  for (const auto& [name, tensor] : file.tensors) {
    EXPECT_EQ(back.tensors.at(name).type, tensor.type);
    EXPECT_EQ(back.tensors.at(name).shape, tensor.shape);
    EXPECT_EQ(back.tensors.at(name).bytes, tensor.bytes);
  }
  EXPECT_FALSE(std::filesystem::exists(path_ + kTemporaryExtension));
}

TEST_F(TensorFileTest, RefusesEveryTruncationAndExtension) {
  Example().Write(path_);
  const std::string bytes = Bytes();
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    Overwrite(bytes.substr(0, length));
    EXPECT_THROW(TensorFile::Read(path_), Error) << length;
  }
  Overwrite(bytes + '\0');
  EXPECT_THROW(TensorFile::Read(path_), Error);
}

TEST_F(TensorFileTest, RefusesAFlippedBitInEveryByte) {
  Example().Write(path_);
  const std::string bytes = Bytes();
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ (1 << i % 8));
    Overwrite(damaged);
    EXPECT_THROW(TensorFile::Read(path_), Error) << "byte " << i << " bit " << i % 8;
  }
}

TEST_F(TensorFileTest, RefusesRandomBytes) {
  std::mt19937 generator(5);
  for (int i = 0; i < 300; ++i) {
    std::string bytes(generator() % 200, '\0');
    for (char& byte : bytes) byte = static_cast<char>(generator());
    Overwrite(bytes);
    EXPECT_THROW(TensorFile::Read(path_), Error);
  }
}

TEST_F(TensorFileTest, RefusesHostileHeadersWithRightChecksums) {
  const std::string metadata = R"({"__metadata__":{"checksum":"0000000000000000"})";
  const auto header = [&](const std::string& rest) { return metadata + rest + "}"; };
  WriteForged(header(R"(,"a":{"dtype":"U8","shape":[4],"data_offsets":[0,4]})"), "abcd");
  EXPECT_EQ(Refusal(), "");
  const char* const hostile[] = {
      R"(,"a":{"dtype":"U8","shape":[5],"data_offsets":[0,4]})",
      R"(,"a":{"dtype":"U8","shape":[-4],"data_offsets":[0,4]})",
      R"(,"a":{"dtype":"U8","shape":[4.0],"data_offsets":[0,4]})",
      R"(,"a":{"dtype":"F16","shape":[2],"data_offsets":[0,4]})",
      R"(,"a":{"dtype":"U8","shape":[4],"data_offsets":[4,0]})",
      R"(,"a":{"dtype":"U8","shape":[4],"data_offsets":[-1,3]})",
      R"(,"a":{"dtype":"U8","shape":[4],"data_offsets":[0]})",
      R"(,"a":{"dtype":"U8","shape":[4]})",
      R"(,"a":{"dtype":"U8","shape":[4],"data_offsets":[0,4],"more":1})",
      R"(,"a":[1])",
      R"(,"a":{"dtype":"U8","shape":[3],"data_offsets":[0,3]})",
      R"(,"a":{"dtype":"U8","shape":[3],"data_offsets":[1,4]})",
      // Parentheses: one text in two parts.
      (R"(,"a":{"dtype":"U8","shape":[3],"data_offsets":[0,3]},)"
       R"("b":{"dtype":"U8","shape":[2],"data_offsets":[2,4]})"),
      R"(,"a":{"dtype":"F32","shape":[4611686018427387905],"data_offsets":[0,4]})",
      R"(,"a":{"dtype":"F64","shape":[4294967296,4294967296],"data_offsets":[0,4]})",
      R"(,"a":{"dtype":"U8","shape":[1e300],"data_offsets":[0,4]})",
  };
  for (const char* const rest : hostile) {
    WriteForged(header(rest), "abcd");
    const std::string refusal = Refusal();
    EXPECT_NE(refusal, "") << rest;
    EXPECT_EQ(refusal.find("checksum"), std::string::npos) << rest << ": " << refusal;
    EXPECT_EQ(refusal.find('\n'), std::string::npos);
  }
  WriteForged("{}", "");
  EXPECT_NE(Refusal().find("checksum"), std::string::npos);
  WriteForged(R"({"__metadata__":{"checksum":7}})", "");
  EXPECT_NE(Refusal(), "");
  WriteForged(std::string(100000, '['), "");
  EXPECT_NE(Refusal(), "");
}

TEST_F(TensorFileTest, WhatBreaksALineIsRefusedInOne) {
  const auto header = [](const std::string& metadata, const std::string& rest) {
    return R"({"__metadata__":{"checksum":"0000000000000000")" + metadata + "}" + rest + "}";
  };
  for (const std::string& forged :
       {header("", R"(,"a\nb":{"dtype":"U8","shape":[0],"data_offsets":[0,0]})"),
        header(R"(,"a\u007f":"b")", ""), header(R"(,"a":"b\nc")", "")}) {
    WriteForged(forged, "");
    EXPECT_NE(Refusal().find("control character"), std::string::npos);
    EXPECT_EQ(Refusal().find('\n'), std::string::npos);
  }
  TensorFile whole_file = Example();
  whole_file.metadata["task_file"] = "lines\nof a file\n";
  whole_file.Write(path_);
  EXPECT_EQ(Refusal(), "");
}

TEST_F(TensorFileTest, WhatCouldNotBeReadIsNotWritten) {
  TensorFile name = Example(), key = Example(), text = Example(), latin_1 = Example();
  TensorFile reserved = Example();
  reserved.tensors["__metadata__"] = {NamedTensor::Type::kU8, {0}, {}};
  name.tensors["a\nb"] = {NamedTensor::Type::kU8, {0}, {}};
  key.metadata["a\x7f"] = "b";
  text.metadata["a"] = "b\nc";
  latin_1.metadata["a"] = "caf\xe9";
  for (const TensorFile& file : {name, key, text, latin_1, reserved}) {
    EXPECT_THROW(file.Write(path_), Error);
    EXPECT_FALSE(std::filesystem::exists(path_));
  }
}

TEST_F(TensorFileTest, HugeLengthsAllocateNothing) {
  Overwrite(std::string(8, '\xff') + "{}");
  EXPECT_NE(Refusal().find("header length"), std::string::npos);
}

TEST_F(TensorFileTest, MissingFilesAndDirectoriesAreNamed) {
  EXPECT_NE(Refusal().find(path_), std::string::npos);
  std::filesystem::create_directory(path_);
  EXPECT_NE(Refusal().find("regular file"), std::string::npos);
}

TEST_F(TensorFileTest, AFailedWriteLeavesTheOldFileAlone) {
  Example().Write(path_);
  const std::string before = Bytes();
  TensorFile wrong = Example();
  wrong.tensors["a"].shape = {7};
  EXPECT_THROW(wrong.Write(path_), Error);
  EXPECT_THROW(Example().Write(scratch_ / "missing/file.skein"), Error);
  EXPECT_EQ(Bytes(), before);
}

}  // namespace
}  // namespace skein
