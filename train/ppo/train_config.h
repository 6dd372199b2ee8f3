// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "envs/env_config.h"
#include "train/network/network_config.h"
#include "train/policy/stored_policy.h"
#include "train/ppo/learner_config.h"
#include "train/ppo/ppo_config.h"

namespace skein {

class FieldList;

/// In-training evaluation, which also chooses the best checkpoint.
struct PeriodicEvaluationConfig {
  int interval_iterations = 20;  ///< 0: never
  int episodes = 256;
};

/// All that a training run depends on.
struct TrainConfig {
  EnvConfig env;
  NetworkConfig network;
  PpoConfig ppo;
  LearnerConfig learner;
  PeriodicEvaluationConfig evaluation;
  /// What flies, frozen, while a high-level policy is trained; null where the policy itself flies.
  std::shared_ptr<const StoredPolicy> low_level;
  std::uint64_t total_steps = 0;  ///< budget in control steps (environment steps at 50 Hz)
  std::uint64_t seed = 1;
};

/// Its settings (base/field_list.h).
void ListFields(PeriodicEvaluationConfig& config, FieldList& list);

/// Its settings (base/field_list.h).
void ListFields(TrainConfig& config, FieldList& list);

/// Throws Error on a learner's values that are out of bounds or do not go together.
void ValidateLearning(const TrainConfig& config);

}  // namespace skein
