// SPDX-License-Identifier: Apache-2.0
#include "src/run/run_directory.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "src/files/output_file.h"
#include "src/files/plain_line.h"
#include "tests/scratch_directory.h"
#include "train/files/file_descriptor.h"

namespace skein {
namespace {

namespace fs = std::filesystem;

class RunDirectoryTest : public ::testing::Test {
 protected:
  const ScratchDirectory scratch_;
  std::string root_ = scratch_.path();
};

TEST_F(RunDirectoryTest, IsHeldByOneAtATime) {
  RunDirectory first = RunDirectory::Create(root_ + "/run");
  WriteFile(first.config(), "");
  EXPECT_THROW(RunDirectory::Open(root_ + "/run"), Error);
  { const RunDirectory moved = std::move(first); }
  EXPECT_NO_THROW(RunDirectory::Open(root_ + "/run"));
}

TEST_F(RunDirectoryTest, CreateRefusesWhatIsNotEmpty) {
  WriteFile(root_ + "/note", "precious");
  EXPECT_THROW(RunDirectory::Create(root_), Error);
  EXPECT_THROW(RunDirectory::Create(root_ + "/note"), Error);
  EXPECT_EQ(ReadFile(root_ + "/note"), "precious");
}

TEST_F(RunDirectoryTest, OpenRefusesWhatIsNotARun) {
  EXPECT_THROW(RunDirectory::Open(root_), Error);
  EXPECT_THROW(RunDirectory::Open(root_ + "/absent"), Error);
}

TEST_F(RunDirectoryTest, WhatAKilledProcessLeftIsNotInTheWay) {
  const std::string path = root_ + "/run";
  RunDirectory::RemoveStub(path);
  EXPECT_FALSE(fs::exists(path));
  {
    const RunDirectory stub = RunDirectory::Create(path);
    for (const std::string& file :
         {stub.low_level(), stub.task_file(), stub.aircraft(), stub.checkpoint(0)}) {
      WriteFile(file, "begun");
      WriteFile(file + kTemporaryExtension, "begun");
    }
    WriteFile(stub.config() + kTemporaryExtension, "begun");
  }
  RunDirectory::RemoveStub(path);
  EXPECT_TRUE(fs::is_empty(path));
  EXPECT_NO_THROW(RunDirectory::Create(path));
}

TEST_F(RunDirectoryTest, RunsAndForeignFilesAreNoStubs) {
  const std::string path = root_ + "/run";
  const RunDirectory run = RunDirectory::Create(path);
  WriteFile(path + "/note", "precious");
  WriteFile(run.aircraft(), "begun");
  RunDirectory::RemoveStub(path);
  EXPECT_FALSE(fs::exists(run.aircraft()));
  EXPECT_EQ(ReadFile(path + "/note"), "precious");
  WriteFile(run.config(), "");
  WriteFile(run.aircraft(), "begun");
  RunDirectory::RemoveStub(path);
  EXPECT_TRUE(fs::exists(run.aircraft()));
}

TEST_F(RunDirectoryTest, TheLowLevelPolicyIsFoundByItsOlderNameToo) {
  const RunDirectory run = RunDirectory::Create(root_ + "/run");
  EXPECT_EQ(run.low_level(), root_ + "/run/low_level.skein");
  WriteFile(root_ + "/run/controller.skein", "older");
  EXPECT_EQ(run.low_level(), root_ + "/run/controller.skein");
  WriteFile(root_ + "/run/low_level.skein", "newer");
  EXPECT_EQ(run.low_level(), root_ + "/run/low_level.skein");
}

TEST_F(RunDirectoryTest, IsKnownToBeHeld) {
  EXPECT_FALSE(IsHeld(root_));
  {
    const RunDirectory run = RunDirectory::Create(root_ + "/run");
    EXPECT_TRUE(IsHeld(root_ + "/run"));
  }
  EXPECT_FALSE(IsHeld(root_ + "/run"));
}

TEST_F(RunDirectoryTest, PruneKeepsTheNewestByNumber) {
  const RunDirectory run = RunDirectory::Create(root_ + "/run");
  for (const std::uint64_t iteration : {2, 1000000, 30, 4}) {
    WriteFile(run.checkpoint(iteration), "x");
  }
  WriteFile(run.best_policy(), "x");
  const std::string temporary = run.checkpoints() + "/checkpoint-12.skein" + kTemporaryExtension;
  WriteFile(temporary, "x");
  run.Prune(2);
  const auto left = run.Checkpoints();
  ASSERT_EQ(left.size(), 2u);
  EXPECT_EQ(left[0].iteration, 30u);
  EXPECT_EQ(left[1].iteration, 1000000u);
  EXPECT_TRUE(fs::exists(run.best_policy()));
  run.RemoveTemporaries();
  EXPECT_FALSE(fs::exists(temporary));
}

TEST_F(RunDirectoryTest, CheckpointsThatCannotBeReadAreNotTakenForNone) {
  EXPECT_TRUE(CheckpointsIn(root_ + "/absent").empty());
  WriteFile(root_ + "/file", "");
  EXPECT_THROW(CheckpointsIn(root_ + "/file"), Error);
}

TEST_F(RunDirectoryTest, LatestIsTheOneWrittenToLast) {
  EXPECT_FALSE(LatestRun(root_, "").has_value());
  for (const char* name : {"/a", "/b", "/c"}) {
    const RunDirectory run = RunDirectory::Create(root_ + name);
    WriteFile(run.config(), "[env]\ntask = \"heading\"\n");
  }
  const auto now = fs::file_time_type::clock::now();
  fs::last_write_time(root_ + "/a/config.toml", now - std::chrono::hours(1));
  fs::last_write_time(root_ + "/b/config.toml", now);
  fs::last_write_time(root_ + "/c/config.toml", now - std::chrono::hours(2));
  EXPECT_EQ(LatestRun(root_, "heading"), root_ + "/b");
  WriteFile(root_ + "/c/metrics.csv", "");
  fs::last_write_time(root_ + "/c/metrics.csv", now + std::chrono::hours(1));
  EXPECT_EQ(LatestRun(root_, ""), root_ + "/c");
  EXPECT_FALSE(LatestRun(root_, "control").has_value());
}

TEST_F(RunDirectoryTest, RunsOfTheSameSecondHaveDirectoriesOfTheirOwn) {
  const RunDirectory first = RunDirectory::CreateIn(root_ + "/runs", "heading");
  const RunDirectory second = RunDirectory::CreateIn(root_ + "/runs", "heading");
  EXPECT_EQ(first.path().rfind(root_ + "/runs/heading-", 0), 0u) << first.path();
  EXPECT_NE(second.path(), first.path());
}

TEST_F(RunDirectoryTest, DocumentsMayHoldNamesThatAreNotUtf8) {
  WriteJson(root_ + "/document", {{"path", "caf\xe9"}});
  EXPECT_EQ(ReadFile(root_ + "/document"), "{\n \"path\": \"caf\xef\xbf\xbd\"\n}\n");
}

TEST_F(RunDirectoryTest, NamesBecomeOneLineOfUtf8) {
  EXPECT_EQ(PlainLine("caf\xc3\xa9 [x] \"y\""), "caf\xc3\xa9 [x] \"y\"");
  EXPECT_EQ(PlainLine("caf\xe9"), "caf\xef\xbf\xbd");
  EXPECT_EQ(PlainLine(std::string("a\nb\tc\0d\x7f", 8)), "a b c d ");
}

TEST_F(RunDirectoryTest, SymbolicLinksLeadToTheFileThatIsReplaced) {
  WriteFile(root_ + "/file", "old");
  fs::create_symlink(root_ + "/file", root_ + "/link");
  WriteFile(root_ + "/link", "new");
  EXPECT_TRUE(fs::is_symlink(root_ + "/link"));
  EXPECT_EQ(ReadFile(root_ + "/file"), "new");
}

TEST_F(RunDirectoryTest, FilesAreReplacedWholeOrNotAtAll) {
  WriteFile(root_ + "/file", "old");
  WriteFile(root_ + "/file", "new");
  EXPECT_EQ(ReadFile(root_ + "/file"), "new");
  EXPECT_THROW(WriteFile(root_ + "/absent/file", "x"), Error);
  EXPECT_THROW(WriteFile("/dev/full", "x"), Error);
  EXPECT_THROW(ReadFile(root_), Error);
}

}  // namespace
}  // namespace skein
