// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "envs/actions.h"
#include "train/measures/command_kernels.h"
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

/// Of each command in `rows`, one row every `interval_s`, by Parseval's theorem: the whole less 2
/// |X(k)|^2 / count over the frequencies k / (count interval_s) of the discrete Fourier transform
/// up to the split, those at the split included.
std::array<SeriesPower, kActionSize> PowerOf(const ActionRows& rows, double interval_s);

/// Measures stick actions in consecutive windows.
class ActionWindows {
 public:
  /// `rows` follow those before. All windows but the last are of kPowerWindowS.
  void Add(const ActionRows& rows, double interval_s);
  /// NaN of what too few rows do not say.
  ActionSmoothness Report(double interval_s) const;

 private:
  std::size_t count_ = 0;
  std::optional<CommandHistory> history_;
  std::array<SeriesPower, kActionSize> power_;
};

/// The stick actions of one flight through consecutive control steps, whatever the rate of the
/// agent, and those of its hold. The formulas are in docs/reference/metrics.md.
class ActionSeries {
 public:
  explicit ActionSeries(double control_interval_s);

  /// Begins anew, in the same memory.
  void Clear();
  /// kActionSize of them, not clipped.
  void Add(const float* action);
  /// The next actions are those of the hold, too.
  void BeginHold();

  ActionSmoothness Report() const { return ReportOf(flight_); }
  ActionSmoothness ReportHold() const { return ReportOf(hold_); }

 private:
  /// One window after another, the latest under way from rows_[begin] on.
  struct Part {
    std::size_t begin = kNowhere;
    ActionWindows windows;
  };
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

  ActionRows RowsFrom(std::size_t begin) const;
  ActionSmoothness ReportOf(const Part& part) const;
  /// Measures windows that are whole, and forgets their rows.
  void CloseWindows();

  double interval_s_;
  std::size_t window_size_;
  /// Measured a window at a time: to go from aircraft to aircraft with every single step would cost
  /// as much as flying it.
  std::vector<std::array<float, kActionSize>> rows_;
  Part flight_, hold_;
};

}  // namespace skein
