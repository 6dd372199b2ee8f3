// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "train/measures/flight_measures.h"

namespace skein {

/// A command that turns back by no more than this has not reversed: 1 % of the way from one stop to
/// the other.
inline constexpr float kReversalDeadBand = 0.02f;
/// Where the power of commands is divided, Hz: a pilot's slow corrections below, chatter above.
inline constexpr double kPowerSplitHz = 1;
/// Power is that of windows of so much, s: the longest flight of the tasks' default time limits is
/// one window.
inline constexpr double kPowerWindowS = 50;
/// What is left of a flight after its last whole window counts if it is this long, s: no shorter
/// series has a frequency of 1 Hz.
inline constexpr double kShortestWindowS = 1;

/// Power of a series about its mean: sums of squares.
struct SeriesPower {
  double whole = 0;
  double above_split = 0;  ///< at frequencies above kPowerSplitHz

  SeriesPower& operator+=(const SeriesPower& other);
};

/// Of `count` values, one every `interval_s`, by Parseval's theorem: the whole less 2 |X(k)|^2 /
/// count over the frequencies k / (count interval_s) of the discrete Fourier transform up to the
/// split, those at the split included.
SeriesPower PowerOf(const float* values, std::size_t count, double interval_s);

/// Counts how often a series turns back by more than `dead_band` from the farthest that it had
/// come: the same for a command that is held for some control steps and for one that moves in each.
class ReversalCounter {
 public:
  explicit ReversalCounter(float dead_band) : dead_band_(dead_band) {}

  void Add(float value);
  int count() const { return count_; }

 private:
  float dead_band_;
  int count_ = 0;
  int direction_ = 0;               // 0 until it has moved by more than the dead band
  float lowest_ = 0, highest_ = 0;  // since it took its direction
  bool is_empty_ = true;
};

/// One command in [-1, 1] through consecutive control steps, whatever the rate of the agent. The
/// formulas are in docs/reference/metrics.md.
class CommandSeries {
 public:
  explicit CommandSeries(double control_interval_s);

  void Add(float command);
  CommandSmoothness Report() const;

 private:
  double interval_s_;
  std::size_t window_size_;
  std::size_t count_ = 0, saturated_ = 0;
  float last_ = 0;
  double variation_ = 0;
  ReversalCounter reversals_{kReversalDeadBand};
  SeriesPower power_;          // of the whole windows
  std::vector<float> window_;  // under way
};

}  // namespace skein
