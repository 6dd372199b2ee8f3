// SPDX-License-Identifier: Apache-2.0
#include "src/run/progress_display.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "src/run/live_view.h"
#include "train/files/file_descriptor.h"

namespace skein {
namespace {

/// The program was stopped and goes on: others have written below the block since.
std::atomic<bool> continued{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void OnContinue(int) { continued = true; }

winsize TerminalSize() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) size = {};
  if (size.ws_col == 0) size.ws_col = 80;
  if (size.ws_row == 0) size.ws_row = 24;
  return size;
}

/// The variable's value; empty if there is none.
std::string Environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// Whether the locale's characters are UTF-8, by the variables that choose it.
bool SpeaksUtf8() {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    std::string value = Environment(name);
    if (value.empty()) continue;
    std::transform(value.begin(), value.end(), value.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return value.find("utf-8") != std::string::npos || value.find("utf8") != std::string::npos;
  }
  return false;
}

/// What a line takes up: escape sequences nothing, a character of several bytes one column.
std::size_t ColumnsOf(const std::string& line) {
  std::size_t columns = 0;
  bool is_escape = false;
  for (const char byte : line) {
    if (byte == '\x1b') is_escape = true;
    columns += !is_escape && (byte & 0xC0) != 0x80;
    if (byte == 'm') is_escape = false;
  }
  return columns;
}

}  // namespace

ProgressDisplay::ProgressDisplay(bool prints)
    : terminal_(prints && isatty(STDOUT_FILENO) == 1 && Environment("TERM") != "dumb"),
      colour_(terminal_ && Environment("NO_COLOR").empty()),
      unicode_(SpeaksUtf8()),
      silent_(!prints) {
  if (!terminal_) return;
  struct sigaction action {};
  action.sa_handler = OnContinue;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGCONT, &action, &replaced_);
}

ProgressDisplay::~ProgressDisplay() {
  if (terminal_) sigaction(SIGCONT, &replaced_, nullptr);
}

void ProgressDisplay::Update(const Progress& progress) {
  constexpr double kTerminalInterval = 0.2, kPlainInterval = 10;
  const auto now = ProgressMeter::Clock::now();
  const std::chrono::duration<double> age = now - last_;
  if (shown_ && age.count() < (terminal_ ? kTerminalInterval : kPlainInterval)) return;
  shown_ = true;
  last_ = now;
  Write(terminal_ ? Block(progress) : FormatProgress(progress, Spacing::kTight) + "\n");
}

/// Each line is overwritten and the rest of it erased, in one write: nothing flickers.
std::string ProgressDisplay::Block(const Progress& progress) {
  constexpr std::size_t kWidest = 79;
  const winsize size = TerminalSize();
  TerminalStyle style;
  style.width = std::min<std::size_t>(kWidest, size.ws_col - 1);
  style.colour = colour_;
  style.unicode = unicode_;
  std::vector<std::string> lines = LiveView(progress, style);
  // One row is the cursor's. What has scrolled out at the top could not be reached again.
  lines.resize(std::min<std::size_t>(lines.size(), std::max(2, int{size.ws_row}) - 1));
  std::string text = ToItsTop();
  block_.clear();
  for (const std::string& line : lines) {
    text += line + "\x1b[K\n";
    block_.push_back(ColumnsOf(line));
  }
  return text + "\x1b[J";
}

/// Leads the cursor to the first row of the block, if there is one.
std::string ProgressDisplay::ToItsTop() {
  if (continued.exchange(false)) block_.clear();
  if (block_.empty()) return "";
  const winsize size = TerminalSize();
  std::size_t rows = 0;
  for (const std::size_t columns : block_) {
    rows += columns == 0 ? 1 : (columns - 1) / size.ws_col + 1;
  }
  return fmt::format("\r\x1b[{}A",
                     std::clamp<std::size_t>(rows, 1, std::max(2, int{size.ws_row}) - 1));
}

std::string ProgressDisplay::Erased() {
  const std::string to_top = ToItsTop();
  block_.clear();
  return to_top.empty() ? "" : to_top + "\x1b[J";
}

void ProgressDisplay::Print(const std::string& line) { Write(Erased() + line + "\n"); }

void ProgressDisplay::Write(const std::string& text) {
  if (silent_) return;
  if (std::fputs(text.c_str(), stdout) != EOF && std::fflush(stdout) == 0) return;
  failure_ = SystemReason();
  silent_ = true;
  // Also drops what the stream still holds, which would fail again when the program ends.
  static_cast<void>(std::freopen("/dev/null", "w", stdout));
}

}  // namespace skein
