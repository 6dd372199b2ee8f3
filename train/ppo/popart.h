// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/network/network.h"
#include "train/ppo/rollout.h"

namespace skein {

/// Moments of the value targets as a moving average (van Hasselt et al. 2016, "Learning values
/// across many orders of magnitude": PopArt).
struct PopArt {
  double mean = 0;
  double mean_square = 1;
  bool started = false;  ///< the first moments are taken whole

  /// What the critic's output stands for: mean and std, at least kMinStd.
  ValueScale scale() const;

  static constexpr double kMinStd = 1e-2;
};

/// Of the value targets of a rollout.
struct TargetMoments {
  double mean = 0, mean_square = 0;
};

/// Moves the moments towards those of the targets by `rate`, and rescales the critic's head so that
/// the values it stands for stay as they were.
void UpdatePopArt(const TargetMoments& targets, double rate, const NetworkLayout& critic,
                  float* parameters, PopArt& popart);

}  // namespace skein
