// SPDX-License-Identifier: Apache-2.0
#include "src/files/input_text.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <thread>

#include "src/files/output_file.h"
#include "tests/scratch_directory.h"

namespace skein {
namespace {

TEST(InputTextTest, OfAPipeIsWhatItHasSaidOnceHoweverOftenItIsRead) {
  const ScratchDirectory scratch;
  const std::string pipe = scratch / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&pipe] { std::ofstream(pipe) << "[env]\nhold_s = 3\n"; });
  EXPECT_EQ(ReadInputText(pipe), "[env]\nhold_s = 3\n");
  writer.join();
  EXPECT_EQ(ReadInputText(pipe), "[env]\nhold_s = 3\n");
}

TEST(InputTextTest, OfAFileIsWhatItSaysNow) {
  const ScratchDirectory scratch;
  const std::string path = scratch / "file";
  for (const char* text : {"one", "two"}) {
    WriteFile(path, text);
    EXPECT_EQ(ReadInputText(path), text);
  }
}

}  // namespace
}  // namespace skein
