// SPDX-License-Identifier: Apache-2.0
#include "train/measures/command_smoothness.h"

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

std::size_t StepsIn(double seconds, double interval_s) {
  return static_cast<std::size_t>(std::lround(seconds / interval_s));
}

/// Sum of |X(k)|^2 over kTogether values of k from `first` on, but none beyond `last`, by
/// Goertzel's recurrence (American Mathematical Monthly 65, 1958): as many as registers hold in one
/// pass.
constexpr std::size_t kTogether = 8;
double SquaresFrom(std::size_t first, std::size_t last, const std::vector<double>& values) {
  double coefficient[kTogether], newest[kTogether] = {}, before[kTogether] = {};
  for (std::size_t i = 0; i < kTogether; ++i) {
    const auto k = static_cast<double>(first + i);
    coefficient[i] = 2 * std::cos(2 * M_PI * k / static_cast<double>(values.size()));
  }
  for (const double value : values) {
    for (std::size_t i = 0; i < kTogether; ++i) {
      const double next = (value - before[i]) + coefficient[i] * newest[i];
      before[i] = newest[i];
      newest[i] = next;
    }
  }
  double squares = 0;
  for (std::size_t i = 0; i < kTogether && first + i <= last; ++i) {
    squares +=
        newest[i] * newest[i] + before[i] * before[i] - coefficient[i] * newest[i] * before[i];
  }
  return squares;
}

/// Sum of 2 |X(k)|^2 / count over k = 1 to `last`.
double PowerUpTo(std::size_t last, const std::vector<double>& values) {
  double squares = 0;
  for (std::size_t k = 1; k <= last; k += kTogether) squares += SquaresFrom(k, last, values);
  return 2 * squares / static_cast<double>(values.size());
}

}  // namespace

SeriesPower& SeriesPower::operator+=(const SeriesPower& other) {
  whole += other.whole;
  above_split += other.above_split;
  return *this;
}

SeriesPower PowerOf(const float* values, std::size_t count, double interval_s) {
  if (count == 0) return {};
  double mean = 0;
  for (std::size_t i = 0; i < count; ++i) mean += values[i];
  mean /= static_cast<double>(count);
  std::vector<double> centred(count);
  SeriesPower power;
  for (std::size_t i = 0; i < count; ++i) {
    centred[i] = values[i] - mean;
    power.whole += centred[i] * centred[i];
  }
  if (power.whole == 0) return power;
  // A frequency at the split must not fall beside it by the rounding of the interval.
  constexpr double kSlack = 1e-6;
  const auto last =
      static_cast<std::size_t>(kPowerSplitHz * static_cast<double>(count) * interval_s + kSlack);
  const double below = PowerUpTo(std::min(last, (count - 1) / 2), centred);
  power.above_split = std::clamp(power.whole - below, 0.0, power.whole);
  return power;
}

void ReversalCounter::Add(float value) {
  if (is_empty_) {
    lowest_ = highest_ = value;
    is_empty_ = false;
  }
  lowest_ = std::min(lowest_, value);
  highest_ = std::max(highest_, value);
  const bool turns_up = direction_ <= 0 && value - lowest_ > dead_band_;
  const bool turns_down = direction_ >= 0 && highest_ - value > dead_band_;
  if (!turns_up && !turns_down) return;
  count_ += direction_ != 0;
  direction_ = turns_up ? 1 : -1;
  lowest_ = highest_ = value;
}

CommandSeries::CommandSeries(double control_interval_s)
    : interval_s_(control_interval_s), window_size_(StepsIn(kPowerWindowS, control_interval_s)) {}

void CommandSeries::Add(float command) {
  if (count_ > 0) variation_ += std::abs(static_cast<double>(command) - last_);
  last_ = command;
  ++count_;
  saturated_ += std::abs(command) >= 1;
  reversals_.Add(command);
  window_.push_back(command);
  if (window_.size() < window_size_) return;
  power_ += PowerOf(window_.data(), window_.size(), interval_s_);
  window_.clear();
}

CommandSmoothness CommandSeries::Report() const {
  CommandSmoothness smoothness;
  if (count_ == 0) return smoothness;
  const auto count = static_cast<double>(count_);
  smoothness.saturated = static_cast<float>(static_cast<double>(saturated_) / count);
  if (count_ == 1) return smoothness;
  const double duration_s = (count - 1) * interval_s_;
  smoothness.variation_per_s = static_cast<float>(variation_ / duration_s);
  smoothness.reversals_per_s = static_cast<float>(reversals_.count() / duration_s);
  if (count_ < StepsIn(kShortestWindowS, interval_s_)) return smoothness;
  SeriesPower power = power_;
  if (window_.size() >= StepsIn(kShortestWindowS, interval_s_)) {
    power += PowerOf(window_.data(), window_.size(), interval_s_);
  }
  smoothness.power_above_split =
      power.whole > 0 ? static_cast<float>(power.above_split / power.whole) : 0.0f;
  return smoothness;
}

}  // namespace skein
