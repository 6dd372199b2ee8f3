// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/range.h"

namespace skein {

class FieldList;

/// The greatest altitude of a start that a configuration may ask for.
inline constexpr double kHighestStartFt = 60000;
/// The same of true airspeeds.
inline constexpr double kSlowestStartFps = 10, kFastestStartFps = 3000;

/// Where episodes begin.
struct InitialConfig {
  Range altitude_ft{19000, 20000};
  Range true_airspeed_fps{1000, 1200};
  /// Trimmed at reset (table of float64 trims, bilinear in altitude and speed). false: the paper's
  /// start, level, alpha 0, surfaces centred, Aircraft::untrimmed_thrust_lbf (F-16: 2000 lbf).
  bool trimmed = true;
  /// In training the least altitude, if it is lower; 0: no other.
  double training_altitude_min_ft = 0;
  /// In training the least true airspeed, if it is lower; 0: no other.
  double training_true_airspeed_min_fps = 0;
  /// In training flights begin banked by up to this, to either side, and otherwise as they would.
  double training_bank_max_deg = 0;
  /// In training flights begin climbing or descending by up to this, and otherwise as they would.
  double training_climb_max_deg = 0;
  /// In training flights begin in a pull of up to this, g, about the pitch axis; 1: in none
  /// (EnvConfig::starting_load_factor_max).
  double training_load_factor_max = 1;

  /// What initial altitudes are drawn from.
  Range drawn_altitude_ft() const { return Lowered(altitude_ft, training_altitude_min_ft); }
  /// What initial true airspeeds are drawn from.
  Range drawn_true_airspeed_fps() const {
    return Lowered(true_airspeed_fps, training_true_airspeed_min_fps);
  }

 private:
  static Range Lowered(const Range& range, double training_min) {
    const bool is_lower = training_min > 0 && training_min < range.min;
    return {is_lower ? training_min : range.min, range.max};
  }
};

/// Its settings (base/field_list.h).
void ListFields(InitialConfig& config, FieldList& list);

}  // namespace skein
