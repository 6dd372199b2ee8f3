// SPDX-License-Identifier: Apache-2.0
#include "envs/high_level_config.h"

#include "base/field_list.h"

namespace skein {

void ListFields(HighLevelConfig& config, FieldList& list) {
  list.Add("pitch_change_rad", &config.pitch_change_rad, Bounds::UpToHalfTurn(),
           "full action of a high-level policy: target pitch above the present one")
      .FixedForPolicies();
  list.Add("yaw_change_rad", &config.yaw_change_rad, Bounds::UpToHalfTurn(),
           "full action of a high-level policy: target yaw to the right of the present one")
      .FixedForPolicies();
  list.Add("speed_change_fps", &config.speed_change_fps, Bounds::NotNegative(),
           "full action of a high-level policy: target true airspeed beyond the present one")
      .FixedForPolicies();
  list.Add("averages_observations", &config.averages_observations,
           "true: a high-level policy sees the mean of its low-level policy's observations since "
           "its "
           "last policy step; false: the last")
      .ChosenByPolicies();
}

}  // namespace skein
