// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/heading_config.h"

#include "base/field_list.h"

namespace skein {

void ListFields(HeadingConfig& config, FieldList& list) {
  list.Add("altitude_change_ft", &config.altitude_change_ft, Bounds::NotNegative(),
           "target altitude: initial + U(-x, x)");
  list.Add("yaw_change_rad", &config.yaw_change_rad, Bounds::UpToHalfTurn(),
           "target yaw: initial + U(-x, x)");
  list.Add("speed_change_fps", &config.speed_change_fps, Bounds::NotNegative(),
           "target true airspeed: initial + U(-x, x)");
  list.Add("altitude_tolerance_ft", &config.altitude_tolerance_ft, Bounds::Positive(),
           "altitude error that counts as reached");
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
  list.Add("earliest_success_step", &config.earliest_success_step, Bounds::CountOrNone(),
           "control step before which nothing counts as reached");
  list.Add("error_norm_weight", &config.error_norm_weight, Bounds::NotNegative(),
           "reward lost per step and unit of the norm of altitude, yaw and speed error")
      .OffUnless(config.error_norm_weight != 1);  // as it is in files from before it was a setting
  list.Add("speed_error_weight", &config.speed_error_weight, Bounds::NotNegative(),
           "reward lost per step and unit of speed error (F-16: 340 m/s), beside the errors' norm");
  list.Add("altitude_error_weight", &config.altitude_error_weight, Bounds::NotNegative(),
           "reward lost per step and unit of altitude error (F-16: 1 km), beside the errors' norm")
      .OffUnless(config.altitude_error_weight > 0);
  list.Add("yaw_error_weight", &config.yaw_error_weight, Bounds::NotNegative(),
           "reward lost per step and rad of yaw error, beside the errors' norm")
      .OffUnless(config.yaw_error_weight > 0);
}

}  // namespace skein
