// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/ppo/train_config.h"

namespace skein {

/// A training that takes a moment and leaves no part out.
inline TrainConfig SmallConfig() {
  TrainConfig config;
  config.env.action_repeat = 5;
  config.env.stagger_clocks = true;
  // Episodes end in every rollout.
  config.env.time_limit_steps = config.env.heading.earliest_success_step = 100;
  config.network.hidden_size = 32;
  config.network.gru_size = 16;
  config.ppo.num_aircraft = 96;
  config.ppo.rollout_steps = 16;
  config.ppo.minibatches = 3;
  config.learner.rollout_tile = 32;
  config.learner.tile_samples = 64;
  config.evaluation.interval_iterations = 2;
  config.evaluation.episodes = 40;
  config.total_steps = 96 * 16 * 5 * 4;
  config.seed = 5;
  return config;
}

}  // namespace skein
