// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/tracking_config.h"

#include "base/field_list.h"
#include "base/name_in.h"

namespace skein {

const char* Name(TrackingAxes axes) { return NameIn(kTrackingAxesNames, axes); }

void ListFields(TrackingConfig& config, FieldList& list) {
  list.AddRange("distance", "ft", &config.distance_ft, {0, 1e6}, "nearest target",
                "farthest target");
  list.Add("azimuth_deg", &config.azimuth_deg, {0, 180},
           "target's direction: left or right of the initial nose by U(-x, x)");
  list.Add("elevation_deg", &config.elevation_deg, {0, 90},
           "target's direction: above or below the initial nose by U(-x, x)");
  list.Add("position_tolerance_ft", &config.position_tolerance_ft, Bounds::Positive(),
           "distance north, east and up of the target that counts as reached");
  list.Add("training_tolerance_max", &config.training_tolerance_max, {1, 1000},
           "in training an episode's tolerance is that times exp(U(0, ln x)); evaluations take it "
           "as "
           "it is")
      .TrainingOnly();
  list.Add("error_axes", &config.error_axes, kTrackingAxesNames,
           "what the errors are: ahead, right and up of the heading; along, right of and above the "
           "path over ground; or north, east and up")
      .ChosenByPolicies();
  list.Add("distance_weight", &config.distance_weight, Bounds::NotNegative(),
           "reward lost per control step and unit of distance (F-16: 1 km) to the target")
      .OffUnless(config.distance_weight != 1);  // as it is in files from before it was a setting
  list.Add("approach_weight", &config.approach_weight, Bounds::NotNegative(),
           "reward gained per unit of distance by which a control step comes nearer")
      .OffUnless(config.approach_weight > 0);
  list.Add("acts_directly", &config.acts_directly,
           "true: the policy gives stick commands itself; false: it is a high-level policy over a "
           "low-level policy")
      .OffUnless(config.acts_directly);
}

}  // namespace skein
