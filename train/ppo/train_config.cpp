// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/train_config.h"

#include "base/error.h"
#include "base/field_list.h"
#include "envs/task_registry.h"
#include "train/ppo/shards.h"

namespace skein {

void ListFields(PeriodicEvaluationConfig& config, FieldList& list) {
  list.Add("interval_iterations", &config.interval_iterations, Bounds::CountOrNone(),
           "iterations between evaluations, which choose the best policy; 0: never");
  list.Add("episodes", &config.episodes, Bounds::Count(), "episodes of each of them");
}

void ListFields(TrainConfig& config, FieldList& list) {
  list.Add("run.total_steps", &config.total_steps, {1, Bounds::WholeNumber().max},
           "budget in control steps (50 Hz), summed over all aircraft");
  list.Add("run.seed", &config.seed, Bounds::WholeNumber(), "seed of every random number");
  list.Group("env", config.env);
  list.Group("network", config.network);
  list.Group("ppo", config.ppo);
  list.Group("learner", config.learner);
  list.Group("evaluation", config.evaluation);
}

void ValidateLearning(const TrainConfig& config) {
  TrainConfig listed = config;
  FieldList list;
  list.Group("network", listed.network);
  list.Group("learner", listed.learner);
  list.Group("evaluation", listed.evaluation);
  list.Check();
  Validate(config.ppo);
  if (!config.ppo.pedals && (config.low_level != nullptr || NeedsLowLevel(config.env))) {
    throw Error("ppo.pedals = false: a high-level policy has no pedals; leave it out");
  }
  if (config.ppo.time_limit_ramp > 0 && config.env.mission.training_time_limit_s == 0) {
    throw Error(
        "configuration: ppo.time_limit_ramp needs env.mission.training_time_limit_s, from which "
        "the time limit grows");
  }
  ValidateShards(config.learner.shards, config.ppo.num_aircraft,
                 config.ppo.rollout_steps / config.ppo.chunk_length, config.ppo.minibatches);
}

}  // namespace skein
