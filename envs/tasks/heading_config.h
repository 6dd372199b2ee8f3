// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

class FieldList;

/// Targets of the Heading task relative to the initial state, when they count as reached, and what
/// errors cost.
struct HeadingConfig {
  double altitude_change_ft = 3000;  ///< initial altitude + U(-x, x)
  double yaw_change_rad = 3;         ///< initial yaw + U(-x, x), wrapped
  double speed_change_fps = 300;     ///< initial true airspeed + U(-x, x)
  double altitude_tolerance_ft = 100;
  double yaw_tolerance_deg = 5;
  double speed_tolerance_fps = 20;
  /// In training an episode's tolerances are these times U(x, 1), which the agent does not see.
  /// 1 is the paper's; with less it learns to come nearer than it must, and sooner.
  double training_tolerance_min = 1;
  /// Time within the tolerances without a break after which the target counts as reached; 0: at
  /// first touch, as in the paper.
  double dwell_s = 0;
  int earliest_success_step = 300;  ///< control steps
  /// Reward lost per step and unit of the norm of the three errors; the paper's is 1.
  double error_norm_weight = 1;
  /// Reward lost per step and unit of speed error (F-16: 340 m/s), beside the errors' norm; the
  /// paper's is 0. The speed is what most targets wait for, and weighs least in the norm.
  double speed_error_weight = 0;
  /// The same of the altitude error (F-16: 1 km): under noise and with sensors that are off, what
  /// the norm has for the last hundred feet is too little.
  double altitude_error_weight = 0;
  /// The same of the yaw error, rad: beside a speed error that thrust takes long to mend, the norm
  /// has next to nothing for the last ten degrees.
  double yaw_error_weight = 0;
};

/// Its settings (base/field_list.h).
void ListFields(HeadingConfig& config, FieldList& list);

}  // namespace skein
