// SPDX-License-Identifier: Apache-2.0
#include "envs/tasks/mission_config.h"

#include "base/field_list.h"

namespace skein {

void ListFields(MissionConfig& config, FieldList& list) {
  list.Add("length_s", &config.length_s, Bounds::NotNegative(),
           "length of a flight of one target after another; 0: an episode has one target")
      .OffUnless(config.enabled());
  list.Add("dwell_s", &config.dwell_s, Bounds::NotNegative(),
           "time for which a target of a mission must be held before the next comes")
      .OffUnless(config.enabled());
  list.Add("training_length_s", &config.training_length_s, Bounds::NotNegative(),
           "the length of flights in training, if it is not 0: evaluations fly what is asked for "
           "above")
      .TrainingOnly()
      .OffUnless(config.is_of_training());
  list.Add("training_time_limit_s", &config.training_time_limit_s, Bounds::NotNegative(),
           "time after which such a flight misses a target (ppo.time_limit_ramp lets it "
           "grow); 0: env.time_limit_steps")
      .TrainingOnly()
      .OffUnless(config.is_of_training() && config.training_time_limit_s > 0);
  list.Add(
          "training_target_share", &config.training_target_share, {0, 1},
          "share of flights of one target in training whose target is what a mission that began as "
          "evaluations do would ask for where they begin")
      .TrainingOnly()
      .OffUnless(config.training_target_share > 0);
}

}  // namespace skein
