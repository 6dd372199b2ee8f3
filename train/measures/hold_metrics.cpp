// SPDX-License-Identifier: Apache-2.0
#include "train/measures/hold_metrics.h"

#include <cmath>

#include "envs/aircraft/aircraft.h"

namespace skein {
namespace {

constexpr double kSecondsPerMinute = 60;

}  // namespace

void HoldSums::Add(const HeldState& state) {
  ++count_;
  within_ += state.is_within;
  for (std::size_t k = 0; k < error_squares_.size(); ++k) {
    const double error = state.errors[k];
    error_squares_[k] += error * error;
  }
  p_squares_ += state.p_rad_s * state.p_rad_s;
  q_squares_ += state.q_rad_s * state.q_rad_s;
  r_squares_ += state.r_rad_s * state.r_rad_s;
  sideslip_squares_ += state.sideslip_rad * state.sideslip_rad;
  // Welford (Technometrics 4, 1962): exact where the deviations are small beside the mean.
  const double deviation = state.load_factor - load_factor_mean_;
  load_factor_mean_ += deviation / count_;
  load_factor_squares_ += deviation * (state.load_factor - load_factor_mean_);
  abs_bank_ += std::abs(state.roll_rad);
  if (follows_) {
    const double change = state.roll_rad - last_roll_rad_;
    // The shorter way round.
    rolled_rad_ += std::abs(change) <= M_PI ? change : change - std::copysign(2 * M_PI, change);
    ++roll_changes_;
  }
  last_roll_rad_ = state.roll_rad;
  follows_ = true;
}

HoldMetrics HoldSums::Report(double control_interval_s, double asked_s) const {
  const double asked = asked_s > 0 ? std::round(asked_s / control_interval_s) : count_;
  HoldMetrics metrics;
  if (asked > 0) metrics.within = static_cast<float>(within_ / asked);
  if (count_ == 0) return metrics;
  const auto rms = [this](double squares, double unit) {
    return static_cast<float>(unit * std::sqrt(squares / count_));
  };
  for (std::size_t k = 0; k < error_squares_.size(); ++k) {
    metrics.rms_errors[k] = rms(error_squares_[k], 1);
  }
  metrics.rms_p = rms(p_squares_, kDegPerRad);
  metrics.rms_q = rms(q_squares_, kDegPerRad);
  metrics.rms_r = rms(r_squares_, kDegPerRad);
  metrics.rms_sideslip = rms(sideslip_squares_, kDegPerRad);
  metrics.load_factor_deviation = rms(load_factor_squares_, 1);
  metrics.mean_abs_bank = static_cast<float>(kDegPerRad * abs_bank_ / count_);
  if (roll_changes_ == 0) return metrics;
  const double rolls = std::abs(rolled_rad_) / (2 * M_PI);
  metrics.net_rolls_per_min =
      static_cast<float>(rolls * kSecondsPerMinute / (roll_changes_ * control_interval_s));
  return metrics;
}

}  // namespace skein
