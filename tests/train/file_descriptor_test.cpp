#include "train/file_descriptor.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "simd/error.h"

namespace skein {
namespace {

class FileDescriptorTest : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = testing::TempDir() + "file_descriptor_test_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(directory_);
    path_ = directory_ + "/file";
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::string Content() const { return FileDescriptor(path_, OpenMode::kRead).ReadToEnd(); }

  std::string directory_, path_;
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
  FileDescriptor(path_, OpenMode::kReplace).Write("abc");
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
  EXPECT_EQ(message_of([&] { FileDescriptor(directory_, OpenMode::kRead).ReadToEnd(); }),
            directory_ + ": cannot be read: Is a directory");
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
    ReplaceFile(directory_ + "/absent/file", [](FileDescriptor&) {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.what(),
              directory_ + "/absent/file: cannot be opened: No such file or directory")
        << "the file, not its temporary";
  }
  const std::filesystem::directory_iterator files(directory_);
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
  ReplaceFile(path_, [](FileDescriptor& file) { file.Write("new"); });
  EXPECT_EQ(Content(), "new");
}

}  // namespace
}  // namespace skein
