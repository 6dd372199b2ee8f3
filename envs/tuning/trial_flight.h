// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "envs/reference/closed_loop.h"

namespace skein {

/// The control interval of trial flights, s.
inline constexpr double kTrialInterval = 0.02;

/// What happened in a flight of the float64 closed loop, one entry per control step; degrees,
/// deg/s, g.
struct TrialFlight {
  std::vector<double> time, alpha, beta, p, q, r, nz, bank;

  /// Beyond 35 deg of alpha, 20 deg of sideslip or 500 deg/s of roll, or not a number.
  bool Departed() const;
};

/// Moves the sticks at a time, s.
using Sticks = std::function<void(double time, PilotCommands* pilot)>;

struct TrialSetting {
  double push = 0;  ///< first, in multiples of (0.05, 0.05, 0.02) rad/s about the body axes
  bool delayed = false;
  int substeps = 1;
};

/// Flies from `trim`, at its power.
TrialFlight FlyTrial(const Plant& plant, const TrimPoint& trim, double seconds,
                     const Sticks& sticks, const TrialSetting& setting = {});

Sticks HandsOff();
Sticks Held(double pitch, double roll, double yaw);
/// What flight control must bear: full sticks held, aft, forward, roll, aft with roll, pedal; and
/// reversed each second, one after the other.
std::vector<Sticks> FullSticks();

/// Standard deviation about a parabola of what `values` do from `start` on: ringing that has not
/// died.
double Ringing(const TrialFlight& flight, const std::vector<double>& values, double start);

/// The greatest magnitude; infinity if any of them is not a number.
double Peak(const std::vector<double>& values);

}  // namespace skein
