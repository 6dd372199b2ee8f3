// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/tuning/frequency_response.h"

namespace skein {

// Low-order equivalent systems, as MIL-F-8785C, 3.1.12, asks for of aircraft whose flight control
// adds modes: the simple transfer function whose frequency response is nearest between 0.1 and 10
// rad/s. Nearest is the least mismatch, 20 times the mean of (gain ratio, dB)^2 + 0.02 (phase
// difference, deg)^2 (MIL-STD-1797A, appendix, 4.2.1.2).

/// Up to that mismatch a pilot hardly tells an aircraft from its equivalent system (there); beyond
/// it the aircraft has none, and requirements of its figures say little.
inline constexpr double kMostMismatch = 10;

/// q / stick = K (s + 1/T) exp(-delay s) / (s^2 + 2 damping frequency s + frequency^2).
struct EquivalentShortPeriod {
  double frequency_rad_s = 0, damping_ratio = 0, delay_s = 0;
  double mismatch = 0;
};

/// `inverse_T` is the lead 1/T, 1/s, which is the airframe's.
EquivalentShortPeriod FitShortPeriod(const SampledSystem& pitch_rate_by_stick, double inverse_T);

/// p / stick = K exp(-delay s) / (time_constant s + 1).
struct EquivalentRoll {
  double time_constant_s = 0, delay_s = 0;
  double mismatch = 0;
};

EquivalentRoll FitRoll(const SampledSystem& roll_rate_by_stick);

}  // namespace skein
