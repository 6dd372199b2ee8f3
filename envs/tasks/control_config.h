// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

class FieldList;

/// Targets of the Control task relative to the initial state, when they count as reached, and what
/// a speed error costs.
struct ControlConfig {
  /// Initial pitch + U(-x, x), folded into [-pi/2, pi/2]: beyond the vertical it comes down again.
  double pitch_change_rad = 0.5;
  double yaw_change_rad = 3;      ///< initial yaw + U(-x, x), wrapped
  double speed_change_fps = 300;  ///< initial true airspeed + U(-x, x)
  double pitch_tolerance_deg = 5;
  double yaw_tolerance_deg = 5;
  double speed_tolerance_fps = 20;
  /// In training an episode's tolerances are these times U(x, 1), which the agent does not see.
  /// 1 is the paper's; with less it learns to come nearer than it must, as a low-level policy under
  /// a high-level policy has to.
  double training_tolerance_min = 1;
  /// Time within the tolerances without a break after which the target counts as reached; 0: at
  /// first touch, as in the paper.
  double dwell_s = 0;
  /// true: the reward's angle is that to the target attitude, wings level, as the paper's; false:
  /// that between the nose and where it should point. Roll does not count for the target, but has
  /// to be flown to reach it: the attitude's angle makes a bank cost more than the turn is worth.
  bool reward_includes_roll = false;
  double angle_error_weight = 1;  ///< reward lost per step and rad of that angle; the paper's is 1
  /// Reward lost per step and unit of speed error (F-16: 340 m/s); the paper's is 0. At 5 the speed
  /// tolerance costs as much as the angular ones, and bringing the nose round at a wrong speed does
  /// not pay.
  double speed_error_weight = 5;
};

/// Its settings (base/field_list.h).
void ListFields(ControlConfig& config, FieldList& list);

}  // namespace skein
