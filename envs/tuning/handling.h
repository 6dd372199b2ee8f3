// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "envs/reference/plant.h"
#include "envs/reference/trim.h"

namespace skein {

/// How an aircraft with flight control flies at one trim: its closed loop's linear model, and
/// flights of the float64 closed loop.
struct Handling {
  /// Least damping ratio of the closed loop's modes faster than 0.5 1/s, by axis, and with surface
  /// commands a step late.
  double pitch_damping = 0, lateral_damping = 0, delayed_damping = 0;
  /// Of the slower modes: least seconds to double.
  double time_to_double_s = std::numeric_limits<double>::infinity();
  /// After a step of a tenth of the pitch stick: seconds to 0.63 of what is reached in 3 s, and how
  /// far beyond that it goes, as a fraction. Not numbers where less than half of it is reached.
  double pitch_rise_s = 0, pitch_overshoot = 0;
  double roll_rate_deg_s = 0;  ///< after 1 s of full roll stick
  bool settles = false;        ///< hands off, 7 s after a push
  /// The most in 4 s of FullSticks.
  double max_alpha_deg = 0, max_sideslip_deg = 0, max_load_factor_g = 0, min_load_factor_g = 0;
  bool departs = false;  ///< TrialFlight::Departed in any of these
};

Handling AssessHandling(const Plant& plant, const TrimPoint& trim);

}  // namespace skein
