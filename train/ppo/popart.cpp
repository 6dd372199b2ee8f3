// SPDX-License-Identifier: Apache-2.0
#include "train/ppo/popart.h"

#include <algorithm>
#include <cmath>

namespace skein {

ValueScale PopArt::scale() const {
  if (!started) return {0, 1};
  return {mean, std::sqrt(std::max(mean_square - mean * mean, kMinStd * kMinStd))};
}

void UpdatePopArt(const TargetMoments& targets, double rate, const NetworkLayout& critic,
                  float* parameters, PopArt& popart) {
  const ValueScale before = popart.scale();
  const double weight = popart.started ? rate : 1;
  popart.mean += weight * (targets.mean - popart.mean);
  popart.mean_square += weight * (targets.mean_square - popart.mean_square);
  popart.started = true;
  const ValueScale after = popart.scale();

  const NormalisedLinear& head = critic.layer(critic.head());
  const double ratio = before.std / after.std;
  for (int j = 0; j < head.in; ++j) {
    float& weight_j = parameters[head.weight + j];
    weight_j = static_cast<float>(weight_j * ratio);
  }
  float& bias = parameters[head.bias];
  bias = static_cast<float>(bias * ratio + (before.mean - after.mean) / after.std);
}

}  // namespace skein
