// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "envs/tuning/trial_flight.h"

namespace skein {

using Flight = TrialFlight;
using Setting = TrialSetting;
inline constexpr double kDt = kTrialInterval;
inline const Sticks kHandsOff = HandsOff();

inline Flight Fly(const Plant& plant, const TrimPoint& trim, double seconds, const Sticks& sticks,
                  const Setting& setting = {}) {
  return FlyTrial(plant, trim, seconds, sticks, setting);
}

}  // namespace skein
