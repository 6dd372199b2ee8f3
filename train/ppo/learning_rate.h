// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "train/ppo/ppo_config.h"

namespace skein {

/// What an adapted learning rate is multiplied or divided by after an iteration, and the smallest
/// one as a share of ppo.learning_rate.
inline constexpr double kLearningRateFactor = 1.5, kLeastLearningRateShare = 0.01;

/// The largest learning rate when `done`, in [0, 1], of the budget is used up: it falls from
/// ppo.learning_rate to ppo.final_learning_rate_fraction of it, as ppo.learning_rate_decay has it.
/// Without ppo.target_kl, the learning rate.
double LargestLearningRate(const PpoConfig& config, double done);

/// What the learning rate after an iteration at `learning_rate` may be by its approximate_kl, for
/// ppo.target_kl above 0: divided by kLearningRateFactor above twice the target, multiplied by it
/// below half of the target, within kLeastLearningRateShare to 1 times ppo.learning_rate.
double AdaptedLearningRate(const PpoConfig& config, double learning_rate, double approximate_kl);

/// What the optimisers step by in an update.
struct LearningRates {
  double actor = 0, critic = 0;
};

/// Both, when `done` of the budget is used up and the actor's is `actor`: of the critic
/// ppo.critic_learning_rate, which falls as LargestLearningRate does, or without one the actor's.
LearningRates LearningRatesBeside(double actor, const PpoConfig& config, double done);

/// The key that sets the critic's.
std::string CriticLearningRateKey(const PpoConfig& config);

}  // namespace skein
