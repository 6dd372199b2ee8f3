// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "src/files/output_file.h"
#include "tests/scratch_directory.h"
#include "tests/src/tiny_training.h"

namespace skein {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// What a terminal shows of a program's output: the few control sequences that the program uses.
class Screen {
 public:
  Screen(std::size_t columns, std::size_t rows) : columns_(columns), rows_(rows) { Grow(); }

  void Show(const std::string& bytes) {
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const char byte = bytes[i];
      if (byte == '\x1b') {
        i = Control(bytes, i);
      } else if (byte == '\r') {
        column_ = 0;
      } else if (byte == '\n') {
        ++row_;
        Grow();
      } else if ((byte & 0xC0) != 0x80) {
        Put(byte);
      }
    }
  }

  /// All that was shown, with what has scrolled out at the top.
  const std::vector<std::string>& lines() const { return lines_; }
  std::size_t row() const { return row_; }
  std::size_t column() const { return column_; }
  bool has_wrapped() const { return has_wrapped_; }
  int LinesWith(const std::string& part) const {
    return static_cast<int>(std::count_if(
        lines_.begin(), lines_.end(),
        [&](const std::string& line) { return line.find(part) != std::string::npos; }));
  }

 private:
  void Grow() {
    while (lines_.size() <= row_) lines_.emplace_back();
  }

  void Put(char byte) {
    if (column_ >= columns_) {
      has_wrapped_ = true;
      column_ = 0;
      ++row_;
      Grow();
    }
    std::string& line = lines_[row_];
    if (line.size() <= column_) line.resize(column_ + 1, ' ');
    line[column_++] = byte;
  }

  /// Obeys the sequence that begins at `at`; returns where it ends.
  std::size_t Control(const std::string& bytes, std::size_t at) {
    const std::size_t end = bytes.find_first_not_of("0123456789;?[", at + 1);
    if (end == std::string::npos) return bytes.size();
    const std::size_t count = std::max(1, std::atoi(bytes.c_str() + at + 2));
    switch (bytes[end]) {
      case 'A':
        EXPECT_LE(count, row_) << "above the first line";
        EXPECT_LT(count, rows_) << "above the top of the window";
        row_ -= std::min(count, row_);
        break;
      case 'K':
        lines_[row_].resize(std::min(lines_[row_].size(), column_));
        break;
      case 'J':
        lines_.resize(row_ + 1);
        lines_[row_].resize(std::min(lines_[row_].size(), column_));
        break;
      default:
        EXPECT_EQ(bytes[end], 'm') << "a mode of the terminal is changed";
    }
    return end;
  }

  std::size_t columns_, rows_, row_ = 0, column_ = 0;
  std::vector<std::string> lines_;
  bool has_wrapped_ = false;
};

/// The program in a terminal of its own.
class TerminalProgram {
 public:
  TerminalProgram(const std::vector<std::string>& arguments, unsigned short columns,
                  unsigned short rows, const std::function<void()>& before = {}) {
    std::vector<std::string> words = {SKEIN_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    winsize size{rows, columns, 0, 0};
    process_ = forkpty(&terminal_, nullptr, nullptr, &size);
    if (process_ != 0) return;
    setenv("TERM", "xterm", 1);
    setenv("LC_ALL", "C.UTF-8", 1);
    unsetenv("NO_COLOR");
    if (before) before();
    execv(SKEIN_PROGRAM, argv.data());
    _exit(126);
  }
  ~TerminalProgram() {
    if (status_ < 0) {
      kill(process_, SIGKILL);
      waitpid(process_, nullptr, 0);
    }
    close(terminal_);
  }
  TerminalProgram(const TerminalProgram&) = delete;
  TerminalProgram& operator=(const TerminalProgram&) = delete;

  void Type(char key) const { EXPECT_EQ(write(terminal_, &key, 1), 1); }
  void Signal(int signal) const { kill(process_, signal); }
  void Resize(unsigned short columns, unsigned short rows) const {
    const winsize size{rows, columns, 0, 0};
    ioctl(terminal_, TIOCSWINSZ, &size);
  }

  /// Reads until the output from `from` on holds `part`; false if the program ends before.
  bool WaitFor(const std::string& part, std::size_t from = 0) {
    while (output_.find(part, from) == std::string::npos) {
      if (!Read()) return false;
    }
    return true;
  }
  /// Reads to the end; the exit code, or -1.
  int Finish() {
    while (Read()) {
    }
    waitpid(process_, &status_, 0);
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
  }
  const std::string& output() const { return output_; }

 private:
  bool Read() {
    constexpr int kPatience_ms = 60000;
    pollfd ready{terminal_, POLLIN, 0};
    char bytes[4096];
    if (poll(&ready, 1, kPatience_ms) <= 0) return false;
    const ssize_t count = read(terminal_, bytes, sizeof bytes);
    if (count <= 0) return false;
    output_.append(bytes, static_cast<std::size_t>(count));
    return true;
  }

  int terminal_ = -1, status_ = -1;
  pid_t process_ = -1;
  std::string output_;
};

class TerminalTraining : public ::testing::Test {
 protected:
  /// One that goes on until it is stopped.
  std::vector<std::string> Endless() const {
    return TinyTraining(scratch_ / "run", {"--set", "run.total_steps=1e9", "--threads", "1"});
  }
  std::vector<std::string> Short() const {
    return TinyTraining(scratch_ / "run", {"--threads", "1"});
  }
  static Screen ShownBy(const TerminalProgram& program, std::size_t columns, std::size_t rows) {
    Screen screen(columns, rows);
    screen.Show(program.output());
    return screen;
  }

  const ScratchDirectory scratch_;
};

/// The end of a block that has been drawn.
constexpr const char* kBlockEnd = "\x1b[J";

TEST_F(TerminalTraining, IsOneBlockAndThenASummaryOfAScreen) {
  constexpr std::size_t kColumns = 80, kRows = 24;
  TerminalProgram program(Short(), kColumns, kRows);
  EXPECT_EQ(program.Finish(), 0) << program.output();
  const Screen screen = ShownBy(program, kColumns, kRows);
  EXPECT_LE(screen.LinesWith("training ["), 1);
  EXPECT_EQ(screen.column(), 0u) << "the cursor is left in a line";
  EXPECT_LE(screen.lines().size(), kRows);
  EXPECT_THAT(program.output(), Not(HasSubstr("\x1b[?"))) << "a mode is changed";
}

TEST_F(TerminalTraining, CtrlCSavesOnceAndLeavesTheTerminalClean) {
  constexpr std::size_t kColumns = 80, kRows = 24;
  TerminalProgram program(Endless(), kColumns, kRows);
  ASSERT_TRUE(program.WaitFor(kBlockEnd));
  ASSERT_TRUE(program.WaitFor(kBlockEnd, program.output().size()));
  program.Type('\x03');
  EXPECT_EQ(program.Finish(), 0) << program.output();
  const Screen screen = ShownBy(program, kColumns, kRows);
  EXPECT_EQ(screen.LinesWith("training ["), 0) << "a block is left behind";
  EXPECT_EQ(screen.column(), 0u);
  EXPECT_EQ(screen.LinesWith("--resume"), 1) << "how it goes on is said once";
  EXPECT_FALSE(CheckpointsIn(scratch_ / "run" + "/checkpoints").empty());
}

TEST_F(TerminalTraining, GoesOnBelowWhatOthersWroteWhileItWasStopped) {
  constexpr std::size_t kColumns = 80, kRows = 24;
  TerminalProgram program(Endless(), kColumns, kRows);
  ASSERT_TRUE(program.WaitFor(kBlockEnd));
  program.Signal(SIGSTOP);
  program.Signal(SIGCONT);
  const std::size_t stopped = program.output().size();
  ASSERT_TRUE(program.WaitFor("training", stopped));
  ASSERT_TRUE(program.WaitFor(kBlockEnd, program.output().size()));
  program.Type('\x03');
  EXPECT_EQ(program.Finish(), 0);
  // The block of before the stop stays as others left it; the one after it is gone.
  EXPECT_LE(ShownBy(program, kColumns, kRows).LinesWith("training ["), 1);
}

TEST_F(TerminalTraining, FitsNarrowAndLowWindows) {
  constexpr std::size_t kColumns = 40, kRows = 5;
  TerminalProgram program(Endless(), kColumns, kRows);
  ASSERT_TRUE(program.WaitFor(kBlockEnd));
  const std::size_t first = program.output().rfind("training", program.output().find(kBlockEnd));
  ASSERT_NE(first, std::string::npos);
  ASSERT_TRUE(program.WaitFor(kBlockEnd, program.output().size()));
  Screen screen(kColumns, kRows);
  screen.Show(program.output().substr(first));
  EXPECT_FALSE(screen.has_wrapped());
  EXPECT_LT(screen.row(), kRows);
}

/// The most rows that the cursor is led up at once.
int LargestStepUp(const std::string& output) {
  int largest = 0;
  for (std::size_t at = output.find("\x1b["); at != std::string::npos;
       at = output.find("\x1b[", at + 1)) {
    const std::size_t end = output.find_first_not_of("0123456789", at + 2);
    if (end != std::string::npos && output[end] == 'A') {
      largest = std::max(largest, std::atoi(output.c_str() + at + 2));
    }
  }
  return largest;
}

TEST_F(TerminalTraining, FollowsAWindowThatBecomesNarrower) {
  constexpr unsigned short kNarrow = 30;
  constexpr int kBlockLines = 6;
  TerminalProgram program(Endless(), 80, 24);
  ASSERT_TRUE(program.WaitFor(kBlockEnd));
  ASSERT_TRUE(program.WaitFor(kBlockEnd, program.output().size()));
  EXPECT_EQ(LargestStepUp(program.output()), kBlockLines);
  program.Resize(kNarrow, 24);
  const std::size_t resized = program.output().size();
  for (int block = 0; block < 4; ++block) {
    ASSERT_TRUE(program.WaitFor(kBlockEnd, program.output().size()));
  }
  // The terminal has broken the lines that were wider.
  EXPECT_GT(LargestStepUp(program.output().substr(resized)), kBlockLines + 1);
  const std::size_t last = program.output().rfind("training", program.output().rfind(kBlockEnd));
  Screen screen(kNarrow, 24);
  screen.Show(program.output().substr(last, program.output().rfind(kBlockEnd) - last));
  EXPECT_FALSE(screen.has_wrapped());
}

TEST_F(TerminalTraining, KeepsWithoutColourWhereItIsUnwanted) {
  TerminalProgram program(Short(), 80, 24, [] { setenv("NO_COLOR", "1", 1); });
  EXPECT_EQ(program.Finish(), 0);
  EXPECT_THAT(program.output(), HasSubstr(kBlockEnd));
  EXPECT_EQ(program.output().find("m", program.output().find("\x1b[3")), std::string::npos);
}

TEST_F(TerminalTraining, IsPlainLinesOnADumbTerminal) {
  TerminalProgram program(Short(), 80, 24, [] { setenv("TERM", "dumb", 1); });
  EXPECT_EQ(program.Finish(), 0);
  EXPECT_THAT(program.output(), Not(HasSubstr("\x1b")));
  EXPECT_THAT(program.output(), HasSubstr("steps"));
}

}  // namespace
}  // namespace skein
