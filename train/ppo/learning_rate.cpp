// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/learning_rate.h"

#include <algorithm>
#include <cmath>

namespace skein {

double LargestLearningRate(const PpoConfig& config, double done) {
  const double last = config.final_learning_rate_fraction;
  if (config.learning_rate_decay == Decay::kExponential) {
    return config.learning_rate * std::pow(last, done);
  }
  return config.learning_rate * (1 - done * (1 - last));
}

double AdaptedLearningRate(const PpoConfig& config, double learning_rate, double approximate_kl) {
  double adapted = learning_rate;
  if (approximate_kl > 2 * config.target_kl) adapted /= kLearningRateFactor;
  if (approximate_kl < config.target_kl / 2) adapted *= kLearningRateFactor;
  return std::clamp(adapted, kLeastLearningRateShare * config.learning_rate, config.learning_rate);
}

LearningRates LearningRatesBeside(double actor, const PpoConfig& config, double done) {
  if (config.critic_learning_rate == 0) return {actor, actor};
  const double share = LargestLearningRate(config, done) / config.learning_rate;
  return {actor, config.critic_learning_rate * share};
}

std::string CriticLearningRateKey(const PpoConfig& config) {
  return config.critic_learning_rate > 0 ? "ppo.critic_learning_rate" : "ppo.learning_rate";
}

}  // namespace skein
