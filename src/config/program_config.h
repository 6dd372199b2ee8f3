// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/ppo/train_config.h"

namespace skein {

class FieldList;

/// When a training run saves itself, and how much of it stays on disk.
struct CheckpointConfig {
  int interval_iterations = 0;  ///< 0: by time alone
  double interval_s = 60;       ///< 0: by iterations alone
  int keep = 3;                 ///< newest checkpoints that stay; the best policy always stays
};

/// Everything that a configuration file can say: what is trained, and how the run is kept.
struct ProgramConfig {
  TrainConfig train;
  CheckpointConfig checkpoint;
  int final_evaluation_episodes = 1000;  ///< fresh episodes flown when training has finished
};

/// Their settings (base/field_list.h): every configuration key, table by table.
void ListFields(CheckpointConfig& config, FieldList& list);
void ListFields(ProgramConfig& config, FieldList& list);

}  // namespace skein
