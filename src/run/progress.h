// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <string>
#include <utility>

#include "train/ppo/trainer.h"

namespace skein {

/// With spaces and long units, or as short as can be.
enum class Spacing { kWide, kTight };

/// "1.35 G", "12.3 M", "999"; tight "1.35G".
std::string FormatCount(double count, Spacing spacing = Spacing::kWide);
/// "47 s", "12 min 05 s", "3 h 07 min", "2 d 04 h"; tight "12m05s".
std::string FormatDuration(double seconds, Spacing spacing = Spacing::kWide);

/// What the progress line shows.
struct Progress {
  std::uint64_t env_steps = 0, total_steps = 0;
  double steps_per_s = 0;  ///< 0: not known yet
  double rollout_share = 0, update_share = 0;
  double return_mean = 0, success_rate = 0;  ///< NaN: no episode has ended yet
  double evaluation_success_rate = -1;       ///< latest; negative: none yet
};

/// One line: steps and budget, steps per second, shares of time, mean return, success, time left.
/// The tight one fits 72 columns and leaves shares and evaluation out.
std::string FormatProgress(const Progress& progress, Spacing spacing = Spacing::kWide);

/// The tight line behind a bar that fills what is left of `width` columns; without the bar, and at
/// last without its end, where that is little. `colour` adds escape sequences, which take no
/// column.
std::string FormatProgressBar(const Progress& progress, std::size_t width, bool colour);

/// Collects iteration reports into a Progress: rates over the last iterations that took about half
/// a minute, the latest values that exist of the others.
class ProgressMeter {
 public:
  using Clock = std::chrono::steady_clock;

  /// `env_steps`: where this process begins (above 0 when resumed).
  ProgressMeter(std::uint64_t env_steps, std::uint64_t total_steps, Clock::time_point start);

  void Add(const IterationReport& report, Clock::time_point now);
  const Progress& progress() const { return progress_; }

 private:
  struct Sample {
    Clock::time_point time;
    std::uint64_t env_steps = 0;
    double rollout_s = 0, update_s = 0;
  };
  std::deque<Sample> samples_;
  Progress progress_;
};

/// Shows lines on the standard output: with a bar, in place, on a terminal that can (TERM is not
/// dumb), in colour unless NO_COLOR is set (no-color.org); else one every ten seconds. Falls silent
/// when the output breaks (its reader has gone, its disk is full).
class ProgressDisplay {
 public:
  ProgressDisplay();
  /// Shows the progress now, or not at all if it is too early.
  void Update(const Progress& progress);
  /// Prints a line that stays.
  void Print(const std::string& line);
  /// The system's reason why it has fallen silent, told once; else empty.
  std::string TakeFailure() { return std::exchange(failure_, ""); }

 private:
  void Write(const std::string& text);

  bool terminal_ = false, colour_ = false;
  bool line_open_ = false;
  bool shown_ = false;
  bool silent_ = false;
  std::string failure_;
  ProgressMeter::Clock::time_point last_;
};

}  // namespace skein
