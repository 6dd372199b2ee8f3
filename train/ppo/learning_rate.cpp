// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/learning_rate.h"

#include <algorithm>

namespace skein {

double LargestLearningRate(const PpoConfig& config, double done) {
  return config.learning_rate * (1 - done * (1 - config.final_learning_rate_fraction));
}

double AdaptedLearningRate(const PpoConfig& config, double learning_rate, double approximate_kl) {
  double adapted = learning_rate;
  if (approximate_kl > 2 * config.target_kl) adapted /= kLearningRateFactor;
  if (approximate_kl < config.target_kl / 2) adapted *= kLearningRateFactor;
  return std::clamp(adapted, kLeastLearningRateShare * config.learning_rate, config.learning_rate);
}

}  // namespace skein
