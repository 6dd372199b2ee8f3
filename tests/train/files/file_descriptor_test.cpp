// SPDX-License-Identifier: Apache-2.0
#include "train/files/file_descriptor.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <thread>

#include "base/error.h"
#include "tests/scratch_directory.h"

namespace skein {
namespace {

class FileDescriptorTest : public testing::Test {
 protected:
  std::string Content() const { return FileDescriptor(path_, OpenMode::kRead).ReadToEnd(100); }

  const ScratchDirectory scratch_;
  const std::string path_ = scratch_ / "file";
};

TEST_F(FileDescriptorTest, AppendsGoToTheEnd) {
  FileDescriptor(path_, OpenMode::kAppend).Write("one");
  FileDescriptor file(path_, OpenMode::kAppend);
  EXPECT_EQ(file.size(), 3u);
  file.Write("two");
  EXPECT_EQ(Content(), "onetwo");
  EXPECT_EQ(file.size(), 6u);
}

TEST_F(FileDescriptorTest, AFileThatEndsTooEarlyIsAnError) {
  FileDescriptor(path_, OpenMode::kMake).Write("abc");
  FileDescriptor file(path_, OpenMode::kRead);
  std::array<char, 4> bytes;
  EXPECT_THROW(file.ReadExactly(bytes.data(), bytes.size()), Error);
}

TEST_F(FileDescriptorTest, ErrorsOfTheSystemAreNamed) {
  const auto message_of = [](const auto& action) -> std::string {
    try {
      action();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message_of([&] { FileDescriptor(path_, OpenMode::kRead); }),
            path_ + ": cannot be opened: No such file or directory");
  EXPECT_EQ(message_of([&] { FileDescriptor(scratch_.path(), OpenMode::kRead).ReadToEnd(100); }),
            scratch_.path() + ": is a directory, not a file");
  EXPECT_EQ(message_of([] { FileDescriptor("/dev/full", OpenMode::kWrite).Write("x"); }),
            "/dev/full: cannot be written: No space left on device");
}

TEST_F(FileDescriptorTest, AReplacementThatFailsLeavesTheOldFileAndNothingElse) {
  ReplaceFile(path_, [](FileDescriptor& file) { file.Write("old"); });
  EXPECT_THROW(ReplaceFile(path_,
                           [](FileDescriptor& file) {
                             file.Write("ne");
                             throw Error("the disk is full");
                           }),
               Error);
  EXPECT_EQ(Content(), "old");
  try {
    ReplaceFile(scratch_ / "absent/file", [](FileDescriptor&) {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), scratch_ / "absent/file: cannot be opened: No such file or directory")
        << "the file, not its temporary";
  }
  const std::filesystem::directory_iterator files(scratch_.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
  ReplaceFile(path_, [](FileDescriptor& file) { file.Write("new"); });
  EXPECT_EQ(Content(), "new");
}

TEST_F(FileDescriptorTest, OfReplacementsAtOnceEachIsWhole) {
  constexpr int kTimes = 40, kBytes = 100;
  const auto replace = [this](char letter) {
    for (int i = 0; i < kTimes; ++i) {
      TryReplacing(path_);
      ReplaceFile(path_, [letter](FileDescriptor& file) {
        for (int k = 0; k < kBytes; ++k) file.Write({&letter, 1});
      });
      const std::string content = Content();
      EXPECT_EQ(content, std::string(kBytes, content.empty() ? letter : content[0]));
    }
  };
  std::thread other(replace, 'b');
  replace('a');
  other.join();
}

TEST_F(FileDescriptorTest, AReplacementKeepsPermissionsAndOtherFiles) {
  namespace fs = std::filesystem;
  const auto write = [](FileDescriptor& file) { file.Write("new"); };
  FileDescriptor(path_ + ".tmp", OpenMode::kMake).Write("a user's");
  FileDescriptor(path_, OpenMode::kMake).Write("old");
  fs::permissions(path_, fs::perms::owner_read | fs::perms::owner_write);
  ReplaceFile(path_, write);
  EXPECT_EQ(Content(), "new");
  EXPECT_EQ(fs::status(path_).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(FileDescriptor(path_ + ".tmp", OpenMode::kRead).ReadToEnd(100), "a user's");

  fs::create_symlink(path_ + ".tmp", path_ + kTemporaryExtension);
  EXPECT_THROW(ReplaceFile(path_, write), Error);
  EXPECT_EQ(FileDescriptor(path_ + ".tmp", OpenMode::kRead).ReadToEnd(100), "a user's");
}

}  // namespace
}  // namespace skein
