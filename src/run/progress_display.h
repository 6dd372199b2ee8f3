// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>
#include <string>
#include <utility>
#include <vector>

#include "src/run/progress.h"

namespace skein {

/// Shows a training on the standard output. On a terminal that can (TERM is not dumb) a block of
/// lines that is drawn anew in its place, in colour unless NO_COLOR is set (no-color.org); else a
/// line every ten seconds. A terminal that becomes narrower breaks the lines of the block, and it
/// is drawn anew over all of them. The cursor always rests below what was written and no mode of
/// the terminal is changed, so that a program that is stopped or killed leaves it whole. Falls
/// silent when the output breaks (its reader has gone, its disk is full). One at a time.
class ProgressDisplay {
 public:
  /// One that does not print is silent from the start.
  explicit ProgressDisplay(bool prints);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  bool is_terminal() const { return terminal_; }
  /// Shows the progress now, or not at all if it is too early.
  void Update(const Progress& progress);
  /// Prints a line that stays, in place of the block.
  void Print(const std::string& line);
  /// The system's reason why it has fallen silent, told once; else empty.
  std::string TakeFailure() { return std::exchange(failure_, ""); }

 private:
  std::string Block(const Progress& progress);
  std::string ToItsTop();
  std::string Erased();
  void Write(const std::string& text);

  struct sigaction replaced_ {};  ///< what handled SIGCONT before
  bool terminal_ = false, colour_ = false, unicode_ = false;
  std::vector<std::size_t> block_;  ///< columns of its lines, above the cursor
  bool shown_ = false;
  bool silent_ = false;
  std::string failure_;
  ProgressMeter::Clock::time_point last_;
};

}  // namespace skein
