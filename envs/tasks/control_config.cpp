// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/control_config.h"

#include "base/field_list.h"

namespace skein {

void ListFields(ControlConfig& config, FieldList& list) {
  list.Add("pitch_change_rad", &config.pitch_change_rad, Bounds::UpToHalfTurn(),
           "target pitch: initial + U(-x, x), folded into +-pi/2");
  list.Add("yaw_change_rad", &config.yaw_change_rad, Bounds::UpToHalfTurn(),
           "target yaw: initial + U(-x, x)");
  list.Add("speed_change_fps", &config.speed_change_fps, Bounds::NotNegative(),
           "target true airspeed: initial + U(-x, x)");
  list.Add("pitch_tolerance_deg", &config.pitch_tolerance_deg, {0, 180, true},
           "pitch error that counts as reached");
  list.Add("yaw_tolerance_deg", &config.yaw_tolerance_deg, {0, 180, true},
           "yaw error that counts as reached");
  list.Add("speed_tolerance_fps", &config.speed_tolerance_fps, Bounds::Positive(),
           "speed error that counts as reached");
  list.Add("training_tolerance_min", &config.training_tolerance_min, Bounds::PositiveFraction(),
           "in training an episode's tolerances are these times U(x, 1); evaluations take them "
           "whole")
      .TrainingOnly();
  list.Add("dwell_s", &config.dwell_s, Bounds::NotNegative(),
           "time within the tolerances without a break after which the target counts as reached; "
           "0: at first touch")
      .OffUnless(config.dwell_s > 0);
  list.Add(
      "reward_includes_roll", &config.reward_includes_roll,
      "true: the reward's angle is to the attitude, wings level; false: to where the nose points");
  list.Add("angle_error_weight", &config.angle_error_weight, Bounds::NotNegative(),
           "reward lost per step and rad of that angle")
      .OffUnless(config.angle_error_weight != 1);  // as it is in files from before it was a setting
  list.Add("speed_error_weight", &config.speed_error_weight, Bounds::NotNegative(),
           "reward lost per step and unit of speed error (F-16: 340 m/s), beside the angle's");
}

}  // namespace skein
