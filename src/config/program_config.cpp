// SPDX-License-Identifier: Apache-2.0
#include "src/config/program_config.h"

#include "base/field_list.h"

namespace skein {

void ListFields(CheckpointConfig& config, FieldList& list) {
  list.Add("interval_iterations", &config.interval_iterations, Bounds::CountOrNone(),
           "iterations between checkpoints; 0: by time alone");
  list.Add("interval_s", &config.interval_s, Bounds::NotNegative(),
           "seconds between checkpoints; 0: by iterations alone");
  list.Add("keep", &config.keep, Bounds::Count(), "newest checkpoints that stay on disk");
}

void ListFields(ProgramConfig& config, FieldList& list) {
  ListFields(config.train, list);
  list.Add("evaluation.final_episodes", &config.final_evaluation_episodes, Bounds::Count(),
           "fresh episodes flown when training has finished");
  list.Group("checkpoint", config.checkpoint);
}

}  // namespace skein
