// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/network/backend.h"

namespace skein {

class FieldList;

/// How the learner computes: but for shards no part of what it learns, apart from rounding.
struct LearnerConfig {
  /// As asked for; ChooseBackend (train/network/backend.h) says what runs.
  Backend backend = Backend::kFused;
  LearnerPrecision precision = LearnerPrecision::kAuto;
  /// Samples per gradient tile: tiles are cut and summed alike on any number of threads.
  int tile_samples = 384;
  int rollout_tile = 64;  ///< aircraft per rollout tile
  /// Into which the aircraft are cut (train/ppo/shards.h); a power of two, part of the result.
  int shards = 1;
};

/// Its settings (base/field_list.h).
void ListFields(LearnerConfig& config, FieldList& list);

}  // namespace skein
