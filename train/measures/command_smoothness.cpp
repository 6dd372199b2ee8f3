// SPDX-License-Identifier: Apache-2.0
#include "train/measures/command_smoothness.h"

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

std::size_t StepsIn(double seconds, double interval_s) {
  return static_cast<std::size_t>(std::lround(seconds / interval_s));
}

CommandSmoothness SmoothnessOf(const CommandHistory& history, const SeriesPower& power,
                               std::size_t command, std::size_t count, double interval_s) {
  CommandSmoothness smoothness;
  smoothness.saturated =
      static_cast<float>(history.saturated[command] / static_cast<double>(count));
  if (count == 1) return smoothness;
  const double duration_s = static_cast<double>(count - 1) * interval_s;
  smoothness.variation_per_s = static_cast<float>(history.variation[command] / duration_s);
  smoothness.reversals_per_s = static_cast<float>(history.reversals[command] / duration_s);
  if (count < StepsIn(kShortestWindowS, interval_s)) return smoothness;
  smoothness.power_above_split =
      power.whole > 0 ? static_cast<float>(power.above_split / power.whole) : 0.0f;
  return smoothness;
}

}  // namespace

SeriesPower& SeriesPower::operator+=(const SeriesPower& other) {
  whole += other.whole;
  above_split += other.above_split;
  return *this;
}

std::array<SeriesPower, kActionSize> PowerOf(const ActionRows& rows, double interval_s) {
  std::array<SeriesPower, kActionSize> power;
  if (rows.count == 0) return power;
  std::vector<double> centred(rows.count * kActionSize);
  const CommandNumbers whole = Centre(rows, centred.data());
  // A frequency at the split must not fall beside it by the rounding of the interval.
  constexpr double kSlack = 1e-6;
  const auto count = static_cast<double>(rows.count);
  const auto last = static_cast<std::size_t>(kPowerSplitHz * count * interval_s + kSlack);
  const CommandNumbers squares =
      SquaresUpTo(std::min(last, (rows.count - 1) / 2), centred.data(), rows.count);
  for (std::size_t k = 0; k < kActionSize; ++k) {
    power[k] = {whole[k], std::clamp(whole[k] - 2 * squares[k] / count, 0.0, whole[k])};
  }
  return power;
}

void ActionWindows::Add(const ActionRows& rows, double interval_s) {
  if (rows.count == 0) return;
  if (!history_) history_ = HistoryBefore(rows);
  Follow(rows, kReversalDeadBand, &*history_);
  count_ += rows.count;
  if (rows.count < StepsIn(kShortestWindowS, interval_s)) return;
  const std::array<SeriesPower, kActionSize> power = PowerOf(rows, interval_s);
  for (std::size_t k = 0; k < kActionSize; ++k) power_[k] += power[k];
}

ActionSmoothness ActionWindows::Report(double interval_s) const {
  ActionSmoothness smoothness;
  if (count_ == 0) return smoothness;
  for (std::size_t k = 0; k < kActionSize; ++k) {
    smoothness[k] = SmoothnessOf(*history_, power_[k], k, count_, interval_s);
  }
  return smoothness;
}

ActionSeries::ActionSeries(double control_interval_s)
    : interval_s_(control_interval_s), window_size_(StepsIn(kPowerWindowS, control_interval_s)) {
  Clear();
}

void ActionSeries::Clear() {
  rows_.clear();
  flight_ = {0, {}};
  hold_ = {};
}

void ActionSeries::Add(const float* action) {
  std::copy_n(action, kActionSize, rows_.emplace_back().begin());
  // The longer of the two windows under way begins with the first row.
  if (rows_.size() >= window_size_) CloseWindows();
}

void ActionSeries::BeginHold() { hold_.begin = rows_.size(); }

ActionRows ActionSeries::RowsFrom(std::size_t begin) const {
  if (begin >= rows_.size()) return {};
  return {rows_[begin].data(), rows_.size() - begin};
}

ActionSmoothness ActionSeries::ReportOf(const Part& part) const {
  ActionWindows windows = part.windows;
  windows.Add(RowsFrom(part.begin), interval_s_);
  return windows.Report(interval_s_);
}

void ActionSeries::CloseWindows() {
  for (Part* part : {&flight_, &hold_}) {
    const ActionRows rows = RowsFrom(part->begin);
    if (rows.count < window_size_) continue;
    part->windows.Add(rows, interval_s_);
    part->begin = rows_.size();
  }
  const std::size_t measured = std::min(flight_.begin, hold_.begin);
  rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(measured));
  flight_.begin -= measured;
  if (hold_.begin != kNowhere) hold_.begin -= measured;
}

}  // namespace skein
