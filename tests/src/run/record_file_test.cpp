// SPDX-License-Identifier: Apache-2.0
#include "src/run/record_file.h"

#include <gtest/gtest.h>

#include "src/files/output_file.h"
#include "tests/scratch_directory.h"

namespace skein {
namespace {

class RecordFileTest : public testing::Test {
 protected:
  const ScratchDirectory scratch_;
  const std::string path_ = scratch_ / "metrics.csv";
};

TEST_F(RecordFileTest, BeginsWithTheHeaderOnce) {
  RecordFile(path_, "a,b\n").Append("1,2\n");
  RecordFile(path_, "a,b\n").Append("3,4\n");
  EXPECT_EQ(ReadFile(path_), "a,b\n1,2\n3,4\n");
}

TEST_F(RecordFileTest, MarksAreThoseOfTheBytesHoweverTheyCameThere) {
  RecordFile first(path_, "a,b\n");
  first.Append("1,2\n");
  const RecordFile again(path_, "");
  EXPECT_EQ(again.Mark(), first.Mark());
  RecordFile whole(scratch_ / "other", "a,b\n1,2\n");
  EXPECT_EQ(whole.Mark(), first.Mark());
}

TEST_F(RecordFileTest, LaterRowsAreNoDamageAndEveryChangedByteIs) {
  RecordFile file(path_, "a,b\n");
  file.Append("1,2\n");
  const std::string mark = file.Mark(), marked = ReadFile(path_);
  file.Append("3,4\n");
  EXPECT_TRUE(BeginsAs(path_, mark));
  for (std::size_t i = 0; i < marked.size(); ++i) {
    std::string damaged = marked;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    WriteFile(path_, damaged);
    EXPECT_FALSE(BeginsAs(path_, mark)) << "byte " << i;
    WriteFile(path_, marked.substr(0, i));
    EXPECT_FALSE(BeginsAs(path_, mark)) << i << " bytes left";
  }
}

TEST_F(RecordFileTest, NoFileAndNoMarkAreUnlikeAnyOther) {
  RecordFile file(path_, "a,b\n");
  EXPECT_FALSE(BeginsAs(scratch_ / "missing", file.Mark()));
  for (const char* mark : {"", "4", "no mark", "-4 0123456789abcdef"}) {
    EXPECT_FALSE(BeginsAs(path_, mark)) << mark;
  }
}

}  // namespace
}  // namespace skein
