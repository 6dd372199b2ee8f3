// SPDX-License-Identifier: Apache-2.0
#include "envs/initial_config.h"

#include "base/field_list.h"

namespace skein {

void ListFields(InitialConfig& config, FieldList& list) {
  list.AddRange("altitude", "ft", &config.altitude_ft, {0, kHighestStartFt},
                "lowest initial altitude", "highest initial altitude");
  list.Add("training_altitude_min_ft", &config.training_altitude_min_ft, {0, kHighestStartFt},
           "in training the lowest initial altitude, from which ppo.condition_ramp and draw_power "
           "count, if it is lower; 0: no other")
      .TrainingOnly()
      .OffUnless(config.training_altitude_min_ft > 0);
  list.Add("training_true_airspeed_min_fps", &config.training_true_airspeed_min_fps,
           {0, kFastestStartFps},
           "in training the lowest initial true airspeed, from which ppo.condition_ramp and "
           "draw_power count, if it is lower; 0: no other")
      .TrainingOnly()
      .OffUnless(config.training_true_airspeed_min_fps > 0);
  list.Add("training_bank_max_deg", &config.training_bank_max_deg, {0, 180},
           "in training flights begin banked by up to this to either side: a turn that a policy "
           "does not begin by itself it learns from its middle")
      .TrainingOnly()
      .OffUnless(config.training_bank_max_deg > 0);
  list.Add("training_climb_max_deg", &config.training_climb_max_deg, {0, 60},
           "in training flights begin climbing or descending by up to this")
      .TrainingOnly()
      .OffUnless(config.training_climb_max_deg > 0);
  list.Add("training_load_factor_max", &config.training_load_factor_max, {1, 9},
           "in training flights begin in a pull of up to so many g, but no more than seven tenths "
           "of env.termination.max_load_factor_g; 1: in none")
      .TrainingOnly()
      .OffUnless(config.training_load_factor_max > 1);
  list.AddRange("true_airspeed", "fps", &config.true_airspeed_fps,
                {kSlowestStartFps, kFastestStartFps}, "lowest initial true airspeed",
                "highest initial true airspeed");
  list.Add("trimmed", &config.trimmed,
           "true: steady flight; false: level, alpha 0, surfaces centred, a set thrust (F-16: 2000 "
           "lbf)");
}

}  // namespace skein
